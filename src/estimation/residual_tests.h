#pragma once

#include <vector>

#include "model/model.h"
#include "uncertainty_identification/estimation/estimate.h"
#include "uncertainty_identification/model/block.h"

namespace uncertainty_identification {

/// Tests whether the residuals are white and uncorrelated with the input, pooled over the
/// experiments (docs/method.md, section on residual tests).
///
/// The residuals are recursive: each whitened sample is predicted from the earlier samples of its
/// experiment, where xi and the nuisances are unknown at first, and the prediction error is divided
/// by its standard deviation relative to sigma. Under the model these residuals are independent
/// with variance sigma^2, whatever the mixture. Residuals at the posterior means of xi are not.
///
/// `noise_parameters` and `plant_parameters` are the numbers of parameters fitted to the same data;
/// they reduce the degrees of freedom. One sweep over the samples.
ResidualTests residualTests(const Model& model, const std::vector<Block>& blocks,
                            const Eigen::VectorXd& parameters, int noise_parameters,
                            int plant_parameters);

}  // namespace uncertainty_identification
