#pragma once

#include <vector>

#include "model/model.h"
#include "uncertainty_identification/estimation/estimate.h"
#include "uncertainty_identification/model/block.h"

namespace uncertainty_identification {

/// Tests whether the residuals of a model are white and independent of the input, pooled over the
/// experiments (docs/method.md, section on residual tests).
///
/// The residuals are recursive ones: each whitened sample minus its prediction from the earlier
/// samples of the experiment, divided by the standard deviation of that prediction error relative
/// to sigma. At an experiment's first sample its error parameters xi and the nuisances are unknown.
/// Under the model these residuals are independent with variance sigma^2 whatever the distribution
/// of xi; the residuals at the posterior means of xi are not.
///
/// `parameters` are theta and the parameters of nuisances. `noise_parameters` and
/// `plant_parameters` are the numbers of parameters that were fitted to the same data; they lower
/// the degrees of freedom. The function passes once over the samples.
ResidualTests residualTests(const Model& model, const std::vector<Block>& blocks,
                            const Eigen::VectorXd& parameters, int noise_parameters,
                            int plant_parameters);

}  // namespace uncertainty_identification
