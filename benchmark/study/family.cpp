#include "study/family.h"

#include <algorithm>
#include <cmath>

namespace uncertainty_identification::study {
namespace {

/// Fewest and most time constants of a kind's plants.
int drawOrder(Kind kind, Draw& draw) {
  switch (kind) {
    case Kind::resonance:
      return 0;
    case Kind::gain:
    case Kind::gain_and_pole:
      return 1;
    case Kind::second_order:
      return 2;
    case Kind::third_order:
      return 3;
    case Kind::nothing:
      return draw.integer(1, 3);
    default:
      return draw.integer(1, 2);
  }
}

/// In samples: the slowest suits the length of the records, the others are clearly faster.
std::vector<double> drawTimeConstants(int order, int samples, Draw& draw) {
  const double slowest = draw.logUniform(2.5, std::min(20.0, samples / 12.0));
  std::vector<double> all;
  const double shares[][2] = {{1, 1}, {0.35, 0.65}, {0.12, 0.25}};
  for (int k = 0; k < order; ++k) all.push_back(slowest * draw.uniform(shares[k][0], shares[k][1]));
  return all;
}

/// exp(deviation): always positive, with this relative standard deviation to first order.
double factor(double deviation) { return std::exp(deviation); }

void varyStructure(const Family& family, Draw& draw, Member* member) {
  if (draw.chance(0.5)) return;
  member->plant.resonance = draw.uniform(0.5, 1.5) / family.sample_time;
  member->plant.damping = draw.uniform(0.05, 0.2);
}

void varyMode(const Family& family, Draw& draw, Member* member) {
  const double side = draw.chance(family.weight) ? -family.distance : family.distance;
  const double scale = factor(side + family.spread * draw.normal());
  (family.pole_varies ? member->plant.time_constants[0] : member->plant.gain) *= scale;
}

void varyGainAndPole(const Family& family, Draw& draw, Member* member) {
  const double first = draw.normal(), second = draw.normal(), rho = family.correlation;
  member->plant.gain *= factor(family.spread * first);
  member->plant.time_constants[0] *=
      factor(family.spread * (rho * first + std::sqrt(1 - rho * rho) * second));
}

}  // namespace

std::string title(Kind kind) {
  static const char* const kNames[kKinds] = {
      "gain",    "pole",      "delay",     "resonance", "gain and pole",  "two modes",
      "nothing", "2nd order", "3rd order", "t noise",   "away from rest", "inexpressible"};
  return kNames[static_cast<int>(kind) - 1];
}

Family drawFamily(Kind kind, int samples, Draw& draw) {
  Family family;
  family.kind = kind;
  family.sample_time = draw.logUniform(1e-3, 10);
  PlantParameters& plant = family.center.plant;
  plant.gain = draw.logUniform(0.01, 100) * (draw.chance(0.8) ? 1 : -1);
  plant.time_constants = drawTimeConstants(drawOrder(kind, draw), samples, draw);
  family.slowest = plant.time_constants.empty() ? 0 : plant.time_constants[0];
  for (double& tau : plant.time_constants) tau *= family.sample_time;
  if (kind == Kind::resonance) {
    const double period = draw.logUniform(0.15, 0.8);  // [rad/sample]
    plant.resonance = period / family.sample_time;
    plant.damping = draw.logUniform(0.05, 0.4);
    family.slowest = 2 / period;
  }
  const double samples_late = kind == Kind::delay ? draw.uniform(1.5, 8)
                              : draw.chance(0.5)  ? draw.uniform(0, 3)
                                                  : 0;
  plant.dead_time = samples_late * family.sample_time;
  family.spread = draw.uniform(0.03, kind == Kind::resonance ? 0.1 : 0.15);
  family.correlation = draw.uniform(0.5, 0.9) * (draw.chance(0.5) ? 1 : -1);
  if (kind == Kind::two_modes) family.spread = draw.uniform(0.02, 0.04);
  family.weight = draw.uniform(0.3, 0.7);
  family.distance = draw.uniform(0.08, 0.2);
  family.pole_varies = draw.chance(0.5);
  family.structure_varies = kind == Kind::inexpressible && draw.chance(0.5);
  return family;
}

Member drawMember(const Family& family, Draw& draw) {
  Member member = family.center;
  const auto vary = [&](double& parameter) { parameter *= factor(family.spread * draw.normal()); };
  switch (family.kind) {
    case Kind::gain:
    case Kind::second_order:
    case Kind::heavy_tails:
      vary(member.plant.gain);
      break;
    case Kind::pole:
    case Kind::third_order:
    case Kind::away_from_rest:
      vary(member.plant.time_constants[0]);
      break;
    case Kind::delay:
      vary(member.plant.dead_time);
      break;
    case Kind::resonance:
      vary(member.plant.resonance);
      break;
    case Kind::gain_and_pole:
      varyGainAndPole(family, draw, &member);
      break;
    case Kind::two_modes:
      varyMode(family, draw, &member);
      break;
    case Kind::nothing:
      break;
    case Kind::inexpressible:
      if (family.structure_varies)
        varyStructure(family, draw, &member);
      else
        member.dead_zone = draw.uniform(0, 0.8);
      break;
  }
  return member;
}

}  // namespace uncertainty_identification::study
