#pragma once

#include <Eigen/Core>
#include <random>

#include "simulation/truth.h"

namespace uncertainty_identification {

/// Draws an input of `samples` values. A multisine must have fewer than samples/2 tones.
Eigen::VectorXd makeInput(const InputTruth& input, int samples, std::mt19937_64& random);

}  // namespace uncertainty_identification
