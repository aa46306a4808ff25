#pragma once

#include <cstdint>
#include <string>

#include "study/draw.h"
#include "study/plant.h"

namespace uncertainty_identification::study {

/// How the plants of a family differ from each other. The numbers are those of the command line.
enum class Kind {
  gain = 1,
  pole,
  delay,
  resonance,
  gain_and_pole,  ///< correlated
  two_modes,      ///< two groups of plants
  nothing,
  second_order,    ///< its gain varies
  third_order,     ///< one of its time constants varies
  heavy_tails,     ///< gain varies, noise with Student's t
  away_from_rest,  ///< pole varies; coloured noise, unknown initial states, output offset
  inexpressible    ///< a dead zone or a structure that differs from plant to plant
};
constexpr int kKinds = 12;

/// In words, for tables.
std::string title(Kind kind);

/// One plant of a family.
struct Member {
  PlantParameters plant;
  double dead_zone = 0;  ///< half width of a dead zone at the input, relative to the input's size
};

/// A family of plants: everything that its plants have in common, and the distribution of the rest.
struct Family {
  Kind kind = Kind::gain;
  double sample_time = 1;  ///< [s]
  double slowest = 1;  ///< [samples] largest time constant, or a third of the resonance's period
  Member center;       ///< the plant in the middle of the distribution
  double spread = 0;   ///< relative standard deviation of what varies
  double correlation = 0;         ///< gain_and_pole: of the two deviations
  double weight = 0.5;            ///< two_modes: share of the first group
  double distance = 0;            ///< two_modes: half the relative distance of the groups
  bool pole_varies = false;       ///< two_modes: the pole differs instead of the gain
  bool structure_varies = false;  ///< inexpressible: instead of the dead zone's width
};

/// Draws a family whose time constants suit records of so many samples.
Family drawFamily(Kind kind, int samples, Draw& draw);

/// Draws a plant of the family.
Member drawMember(const Family& family, Draw& draw);

}  // namespace uncertainty_identification::study
