#pragma once

#include <vector>

#include "model/model.h"
#include "uncertainty_identification/estimation/estimate.h"
#include "uncertainty_identification/model/block.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// Tests whether the residuals of a model are white and independent of the input, pooled over the
/// experiments (docs/method.md, section on residual tests).
///
/// The residuals are recursive ones (recursive_residuals.h). Under the model they are independent
/// with variance sigma^2 whatever the distribution of xi; the residuals at the posterior means of
/// xi are not.
///
/// `parameters` are all parameters of `model`, estimated from the same data by whatever method: the
/// tests leave out what a small change of them would change (Neyman's C(alpha) tests). The function
/// passes once over the samples. With `nominal`, the polynomials of Go and H, it also tests against
/// what a plant that is not linear would add (nonlinear_signals.h).
ResidualTests residualTests(const Model& model, const std::vector<Block>& blocks,
                            const Eigen::VectorXd& parameters,
                            const Polynomials* nominal = nullptr);

}  // namespace uncertainty_identification
