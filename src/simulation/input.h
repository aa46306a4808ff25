#pragma once

#include <Eigen/Core>
#include <random>

#include "simulation/truth.h"

namespace uncertainty_identification {

/// An input of `samples` values. A multisine needs more than twice as many as it has tones.
Eigen::VectorXd makeInput(const InputTruth& input, int samples, std::mt19937_64& random);

}  // namespace uncertainty_identification
