#pragma once

#include <Eigen/Core>

#include "model/model.h"

namespace uncertainty_identification {

/// The recursive residuals of one experiment and how they depend on the model's parameters. Rows
/// are samples; those without a residual are zero.
struct RecursiveResiduals {
  Eigen::VectorXd values;
  Eigen::VectorXd valid;        ///< 1 at samples with a residual, otherwise 0
  Eigen::MatrixXd derivatives;  ///< with respect to each parameter; a column each
};

/// Residuals of one lane of a block by recursive least squares: each whitened sample minus its
/// prediction from the earlier ones, with error parameters xi and nuisances unknown at the start,
/// divided by the standard deviation of that prediction's error relative to sigma. `response` must
/// contain derivatives.
RecursiveResiduals recursiveResiduals(const Response& response, const Block& block, int lane);

}  // namespace uncertainty_identification
