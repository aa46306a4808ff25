#pragma once

#include <Eigen/Core>
#include <vector>

#include "model/model.h"

namespace uncertainty_identification {

/// Gram matrix of each lane. A signal without samples stands for zero.
std::vector<Eigen::MatrixXd> gramOf(std::vector<const Signals*> signals, int lanes);

/// Most likely coefficients of the random-effect columns of each lane (columns x kLanes), where
/// `unexplained` is the residual less the contribution of xi: zeta = (Z'Z + precision)^-1 Z'(e -
/// Phi xi).
Eigen::MatrixXd columnCoefficients(const Response& response, const Signals& unexplained, int lanes);

/// The residual e - Phi xi of a block, with xi given as columns of all experiments.
Signals unexplainedBy(const Response& response, const Block& block, const Eigen::MatrixXd& xi);

}  // namespace uncertainty_identification
