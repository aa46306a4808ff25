#pragma once

#include <random>
#include <string>

#include "simulation/truth.h"
#include "uncertainty_identification/model/nominal_model.h"

/// The plant of one experiment where a parameter of Go varies from experiment to experiment.
namespace uncertainty_identification {

/// Throws ConfigurationError unless the plant has a parameter of this name, which is not 0.
void requireParameter(const PlantTruth& plant, const std::string& name);

/// Go of a plant; first_order with its time constant [s], polynomials with theirs.
Polynomials plantPolynomials(const PlantTruth& plant, double sample_time);

/// The plant with its parameter times 1 + d, d ~ N(0, deviation^2) drawn anew while the plant were
/// not stable; d goes to `deviation`.
PlantTruth spreadPlant(const PlantTruth& plant, const ParameterSpreadTruth& spread,
                       std::mt19937_64& random, double* deviation);

}  // namespace uncertainty_identification
