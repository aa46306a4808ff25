#pragma once

#include <Eigen/Core>
#include <vector>

#include "uncertainty_identification/model/block.h"

/// Statistics and p-values that the tests of residuals share.
namespace uncertainty_identification {

/// p-value of a statistic that is chi-squared with `degrees` degrees of freedom: the probability
/// that it exceeds `sum`. Returns `undefined` where `sum` is not finite or `degrees` is below 1.
double chiSquaredTail(double sum, double degrees, double undefined);

/// p-value of a statistic that is standard normal: the probability that its absolute value exceeds
/// that of `z`; 1 where `z` is not finite.
double twoSidedNormalTail(double z);

/// A quadratic form x' A^+ x with the rank of A, which is its degrees of freedom.
struct QuadraticForm {
  double value = 0, rank = 0;
};

/// x' A^+ x for a symmetric positive semidefinite A, on the subspace that A determines well: the
/// eigenvectors whose eigenvalue is below `threshold` times the largest one are left out.
QuadraticForm quadraticForm(const Eigen::MatrixXd& A, const Eigen::VectorXd& x, double threshold);

/// What the estimation of parameters did to residuals w with derivatives d_j: the estimate moved
/// the residuals along d_j. Both matrices without sigma^2.
struct EstimatedParameters {
  Eigen::MatrixXd information;  ///< sum of d_j d_k (p x p)
  Eigen::VectorXd score;        ///< sum of d_j w (p)

  explicit EstimatedParameters(Eigen::Index parameters);

  /// Adds residuals and their derivatives, a row for each sample.
  void add(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& derivatives);

  /// The sum of squares of w that the parameters would explain, and their number.
  QuadraticForm explained() const;
};

/// Products of residuals with k test signals that are independent of them under the model.
struct TestedProducts {
  Eigen::MatrixXd squares;           ///< sum of products of the test signals (k x k)
  Eigen::VectorXd with_residual;     ///< sum of test signal times residual (k)
  Eigen::MatrixXd with_derivatives;  ///< sum of test signal times residual's derivative (k x p)

  TestedProducts(Eigen::Index signals, Eigen::Index parameters);

  /// Adds test signals, residuals and their derivatives, a row for each sample.
  void add(const Eigen::MatrixXd& signals, const Eigen::VectorXd& residuals,
           const Eigen::MatrixXd& derivatives);
};

/// The quadratic form of the products whose value over sigma^2 is chi-squared where the model is
/// true and its parameters were estimated by any consistent method: the part of the test signals
/// that the derivatives explain is removed from them (Neyman's C(alpha) test). Combinations of
/// which hardly anything is left are left out.
QuadraticForm withoutParameters(const TestedProducts& tested,
                                const EstimatedParameters& parameters);

/// Sums of products of samples 1, ..., `lags` apart, divided by sqrt(`samples`): each has standard
/// deviation 1 where the samples are independent with variance 1. One signal per block; samples
/// that were not measured are 0, and `samples` counts the measured ones.
Eigen::VectorXd scaledCorrelations(const std::vector<Signals>& signals, int lags, double samples);

/// Sums of a signal over `bins` equal parts of each experiment's duration, summed over the
/// experiments and divided by the square root of the number of measured samples in the bin: each
/// has standard deviation 1 where the samples are independent with variance 1.
Eigen::VectorXd scaledTimeBins(const std::vector<Signals>& signals,
                               const std::vector<Block>& blocks, int bins);

}  // namespace uncertainty_identification
