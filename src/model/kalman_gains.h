#pragma once

#include <Eigen/Core>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/model/block.h"

namespace uncertainty_identification {

/// The noise model of which kalmanGains() computes the Kalman filter.
struct NoisePolynomials {
  Eigen::VectorXd c, d;  ///< of the same length, the order m, without a leading 1
  int nc = 0, nd = 0;    ///< coefficients with respect to which derivatives are wanted
  NoiseStart start = NoiseStart::stationary;
};

/// The Kalman filter of the noise in one lane of a block from sample `first` on, one column for
/// each sample; earlier columns are zero. Rows 0 to m - 1 are g_i(t), row m is 1/sqrt(S_t); for
/// each of c1.., d1.. the derivatives of these m + 1 rows follow. With `until_forgotten` the
/// columns end where the initial state is forgotten, so that g_i = c_i and S = 1 from there on.
Eigen::MatrixXd kalmanGains(const NoisePolynomials& noise, const Block& block, int lane, int first,
                            bool until_forgotten);

}  // namespace uncertainty_identification
