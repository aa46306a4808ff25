#include "residual_tests/test_statistics.h"

#include <algorithm>
#include <cmath>

#include "math/distributions.h"
#include "math/symmetric_eigen.h"

namespace uncertainty_identification {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

double chiSquaredTail(double sum, double degrees, double undefined) {
  if (!std::isfinite(sum) || degrees < 1) return undefined;
  return chiSquaredTail(std::max(0.0, sum), degrees);
}

double twoSidedNormalTail(double z) { return std::isfinite(z) ? 2 * normalTail(std::abs(z)) : 1; }

QuadraticForm quadraticForm(const MatrixXd& A, const VectorXd& x, double threshold) {
  const SymmetricEigen of_A(A);
  const VectorXd along = of_A.eigenvectors().transpose() * x;
  QuadraticForm form;
  for (Index k = 0; k < x.size(); ++k) {
    if (of_A.eigenvalues()[k] < threshold * of_A.eigenvalues().maxCoeff()) continue;
    form.value += along[k] * along[k] / of_A.eigenvalues()[k];
    ++form.rank;
  }
  return form;
}

namespace {

// Relative eigenvalue of the test signals' covariance below which a direction is hardly excited.
constexpr double kHardlyMoved = 1e-9;
// Relative eigenvalue of the information below which the residuals do not depend on a direction of
// the parameters.
constexpr double kWithoutEffect = 1e-9;
// Share of a combination of test signals that must be left after the parameters are removed.
constexpr double kLeft = 0.05;

/// The eigenvectors of eigenvalues above `threshold` times the largest one, each over the square
/// root of its eigenvalue: W'AW = 1.
MatrixXd whiteningOf(const MatrixXd& A, double threshold) {
  const SymmetricEigen of_A(A);
  const double largest = A.rows() > 0 ? of_A.eigenvalues().maxCoeff() : 0;
  Index determined = 0;
  while (determined < A.rows() &&
         of_A.eigenvalues()[A.rows() - 1 - determined] > std::max(threshold * largest, 0.0))
    ++determined;
  return of_A.eigenvectors().rightCols(determined) *
         of_A.eigenvalues().tail(determined).cwiseSqrt().cwiseInverse().asDiagonal();
}

/// Coordinates of the parameters in which their information is 1, without directions that have no
/// effect (p x rank).
MatrixXd parameterDirections(const MatrixXd& information) {
  VectorXd size = information.diagonal().cwiseSqrt();
  size = (size.array() > 0).select(size, 1.0);
  const MatrixXd scale = size.cwiseInverse().asDiagonal();
  return scale * whiteningOf(scale * information * scale, kWithoutEffect);
}

}  // namespace

EstimatedParameters::EstimatedParameters(Index parameters)
    : information(MatrixXd::Zero(parameters, parameters)), score(VectorXd::Zero(parameters)) {}

void EstimatedParameters::add(const VectorXd& residuals, const MatrixXd& derivatives) {
  information.noalias() += derivatives.transpose() * derivatives;
  score.noalias() += derivatives.transpose() * residuals;
}

QuadraticForm EstimatedParameters::explained() const {
  const MatrixXd W = parameterDirections(information);
  return {(W.transpose() * score).squaredNorm(), static_cast<double>(W.cols())};
}

TestedProducts::TestedProducts(Index signals, Index parameters)
    : squares(MatrixXd::Zero(signals, signals)),
      with_residual(VectorXd::Zero(signals)),
      with_derivatives(MatrixXd::Zero(signals, parameters)) {}

void TestedProducts::add(const MatrixXd& signals, const VectorXd& residuals,
                         const MatrixXd& derivatives) {
  squares.noalias() += signals.transpose() * signals;
  with_residual.noalias() += signals.transpose() * residuals;
  with_derivatives.noalias() += signals.transpose() * derivatives;
}

QuadraticForm withoutParameters(const TestedProducts& tested,
                                const EstimatedParameters& parameters) {
  const MatrixXd W = parameterDirections(parameters.information);
  const MatrixXd V = whiteningOf(tested.squares, kHardlyMoved);
  const MatrixXd shared = V.transpose() * tested.with_derivatives * W;
  const VectorXd rest =
      V.transpose() * tested.with_residual - shared * (W.transpose() * parameters.score);
  const MatrixXd left = MatrixXd::Identity(V.cols(), V.cols()) - shared * shared.transpose();
  QuadraticForm form;
  if (left.size() == 0 || !left.allFinite()) return form;  // e.g. residuals that are all zero
  const SymmetricEigen of_left(left);
  for (Index k = 0; k < V.cols(); ++k) {
    const double share = of_left.eigenvalues()[k];
    if (share < kLeft) continue;
    const double along = of_left.eigenvectors().col(k).dot(rest);
    form.value += along * along / share;
    ++form.rank;
  }
  return form;
}

VectorXd scaledCorrelations(const std::vector<Signals>& signals, int lags, double samples) {
  VectorXd sums = VectorXd::Zero(lags);
  for (const Signals& signal : signals) {
    for (int k = 1; k <= std::min<int>(lags, static_cast<int>(signal.cols()) - 1); ++k)
      sums[k - 1] +=
          (signal.rightCols(signal.cols() - k) * signal.leftCols(signal.cols() - k)).sum();
  }
  return sums / std::sqrt(samples);
}

VectorXd scaledTimeBins(const std::vector<Signals>& signals, const std::vector<Block>& blocks,
                        int bins) {
  VectorXd sums = VectorXd::Zero(bins), counts = VectorXd::Zero(bins);
  for (std::size_t b = 0; b < signals.size(); ++b) {
    const Block& block = blocks[b];
    for (int lane = 0; lane < block.lanes; ++lane) {
      const int length = block.lengths[static_cast<std::size_t>(lane)];
      for (int t = 0; t < length; ++t) {
        const int bin = t * bins / length;
        sums[bin] += signals[b](lane, t);
        counts[bin] += block.weight(lane, t);
      }
    }
  }
  return sums.cwiseQuotient(counts.cwiseMax(1).cwiseSqrt());
}

}  // namespace uncertainty_identification
