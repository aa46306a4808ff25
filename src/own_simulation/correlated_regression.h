#pragma once

#include <Eigen/Core>

namespace uncertainty_identification {

/// Least-squares estimates with standard errors that hold for autocorrelated residuals.
struct Regression {
  Eigen::VectorXd coefficients;  ///< n
  Eigen::VectorXd variances;     ///< n, of the coefficients
  Eigen::VectorXd degrees;       ///< n, of freedom of Student's t for their intervals
};

/// The coefficients alone: y [N] on the columns [N x n], which must be linearly independent. Rows
/// that are not to be used hold zeros in both.
Eigen::VectorXd leastSquares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& y);

/// The same with variances. A coefficient is a weighted sum over time of residuals that may be
/// correlated. Its variance is the mean of the squared projections of the summands on cosines of
/// low frequencies, which are nearly independent: the equal-weighted cosine estimator of Lazarus,
/// Lewis, Stock and Watson, "HAR inference: recommendations for practice", Journal of Business &
/// Economic Statistics 36(4), 2018. The number of cosines is half the root of N, from 6 to 32. What
/// the regression takes out of the residuals is made up for, and the degrees of freedom are
/// counted, as if they were white: Bell and McCaffrey, "Bias reduction in standard errors for
/// linear regression with multi-stage samples", Survey Methodology 28(2), 2002.
Regression regress(const Eigen::MatrixXd& columns, const Eigen::VectorXd& y);

/// The share of the last column's sum of squares that the other columns do not explain, 0 to 1.
double independentShare(const Eigen::MatrixXd& columns);

}  // namespace uncertainty_identification
