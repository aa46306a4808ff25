#pragma once

#include <random>
#include <string>

#include "simulation/truth.h"
#include "uncertainty_identification/model/nominal_model.h"

/// The plant of one experiment when a parameter of Go differs between experiments.
namespace uncertainty_identification {

/// Throws ConfigurationError unless the plant has a parameter of this name that is not 0.
void requireParameter(const PlantTruth& plant, const std::string& name);

/// The polynomials of Go, for either structure of the plant. `sample_time` is in seconds.
Polynomials plantPolynomials(const PlantTruth& plant, double sample_time);

/// The plant with its parameter multiplied by 1 + d, d ~ N(0, spread.deviation^2). When the result
/// would be unstable, d is drawn again. `deviation` receives d.
PlantTruth spreadPlant(const PlantTruth& plant, const ParameterSpreadTruth& spread,
                       std::mt19937_64& random, double* deviation);

}  // namespace uncertainty_identification
