#pragma once

#include <string>
#include <vector>

#include "curves/curve_model.h"
#include "curves/place.h"
#include "curves/simulation_data.h"

/// Linear plants behind what was found to act on their input. A plant that was fitted without it is
/// far from the true one, from which no small step leads back.
namespace uncertainty_identification {

/// Widths of a play, or limits of the rate, to begin with. In a closed loop most changes of the
/// input are noise and few reach the limit, so that limits of very different size must be tried.
std::vector<double> widthsFor(const SimulationData& data, Place place);

/// The plant that follows the input behind the play or limit, with the width for which it simulates
/// best.
CurveModel startBehind(const SimulationData& data, const CurveModel& linear, Place place);

/// A plant that is driven by the input and `ratio` times a covariate, both in standard deviations.
struct PlantBesideCovariate {
  CurveModel plant;
  double ratio = 0;
};

/// The plant, of the order and delay of `linear`, with the ratio of a plant that has a numerator
/// for each of the two: a second input may move the output more than the first does. Its order is 0
/// if none can be fitted.
PlantBesideCovariate plantBeside(const SimulationData& data, const CurveModel& linear,
                                 const std::string& covariate);

}  // namespace uncertainty_identification
