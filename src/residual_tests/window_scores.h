#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/model.h"

namespace uncertainty_identification {

/// The scores of consecutive parts of experiments, from their recursive residuals: the gradient of
/// the log-likelihood with respect to [parameters; log noise_variance], a column for each part
/// ((p + 1) x parts). `model` must have no regressors. About `parts` parts of equal length, at
/// least one for each experiment. They take the place of the scores of experiments, where these are
/// too few, in robust standard errors: the scores of parts that are long beside the plant's memory
/// are independent, also where the noise is coloured and the model says that it is white.
Eigen::MatrixXd windowScores(const Model& model, const std::vector<Block>& blocks,
                             const Eigen::VectorXd& parameters, double noise_variance, int parts);

}  // namespace uncertainty_identification
