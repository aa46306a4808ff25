#pragma once

#include <vector>

#include "model/model.h"
#include "uncertainty_identification/estimation/estimate.h"
#include "uncertainty_identification/model/block.h"

namespace uncertainty_identification {

/// Tests whether what the model leaves of the data is white and holds nothing of the input, pooled
/// over the experiments (docs/method.md, section on residual tests).
///
/// Residuals are the recursive ones: each whitened sample less its prediction from the experiment's
/// samples before, xi and the nuisances unknown at the start, divided by its standard deviation
/// relative to sigma. Under the model they are independent with variance sigma^2 whatever the
/// mixture, which residuals at the posterior means of xi are not.
///
/// `noise_parameters` and `plant_parameters` were fitted to the same data and lower the degrees of
/// freedom. One sweep over the samples.
ResidualTests residualTests(const Model& model, const std::vector<Block>& blocks,
                            const Eigen::VectorXd& parameters, int noise_parameters,
                            int plant_parameters);

}  // namespace uncertainty_identification
