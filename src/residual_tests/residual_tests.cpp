#include "residual_tests/residual_tests.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "residual_tests/test_statistics.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kLags = 20;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
// Variance over sigma^2 of the coefficients before the first sample: so large that it states
// nothing.
constexpr double kUnknown = 1e8;
// Variance over sigma^2 of a sample's prediction above which the sample only determines the
// coefficients, and is no residual itself.
constexpr double kUndetermined = 1e4;
// Relative eigenvalue of the input's covariance below which the input hardly moves in a direction.
constexpr double kHardlyMoved = 1e-9;

/// Residuals of one experiment at its samples, zero where there is none. `valid` is 1 at samples
/// with a residual.
struct Residuals {
  VectorXd values, valid;
};

/// Whitened [Z Phi] of a lane, with columns scaled to mean square 1.
MatrixXd columnsOf(const Response& response, int lane, Index samples) {
  const WhitenedSignals& value = response.value;
  MatrixXd columns =
      MatrixXd::Zero(samples, static_cast<Index>(value.columns.size() + value.regressors.size()));
  Index at = 0;
  const auto put = [&](const Signals& signal) {
    if (signal.cols() > 0) columns.col(at) = signal.row(lane).head(samples).transpose();
    ++at;
  };
  for (const auto& column : value.columns) put(*column);
  for (const Signals& regressor : value.regressors) put(regressor);
  for (Index k = 0; k < columns.cols(); ++k) {
    const double size = columns.col(k).norm() / std::sqrt(static_cast<double>(samples));
    if (size > 0) columns.col(k) /= size;
  }
  return columns;
}

/// Residuals of one experiment by recursive least squares: each sample is predicted with the
/// coefficients of the columns that the samples before it determine.
Residuals residualsOf(const Response& response, const Block& block, int lane) {
  const Index samples = block.lengths[static_cast<std::size_t>(lane)];
  const MatrixXd X = columnsOf(response, lane, samples);
  MatrixXd P = kUnknown * MatrixXd::Identity(X.cols(), X.cols());
  VectorXd coefficients = VectorXd::Zero(X.cols());
  Residuals residuals{VectorXd::Zero(samples), VectorXd::Zero(samples)};
  for (Index t = 0; t < samples; ++t) {
    const double e = response.value.residual(lane, t);
    // Samples that are missing or left out of the likelihood are zero in all whitened signals.
    if (block.weight(lane, t) == 0 || (e == 0 && X.row(t).isZero(0))) continue;
    const VectorXd Px = P * X.row(t).transpose();
    const double variance = 1 + X.row(t) * Px, innovation = e - X.row(t) * coefficients;
    if (variance < kUndetermined) {
      residuals.values[t] = innovation / std::sqrt(variance);
      residuals.valid[t] = 1;
    }
    coefficients += Px * (innovation / variance);
    P -= Px * Px.transpose() / variance;
  }
  return residuals;
}

/// Sums over all experiments.
struct Sums {
  VectorXd products = VectorXd::Zero(kLags + 1);  ///< of residuals with distance k
  VectorXd pairs = VectorXd::Zero(kLags + 1);     ///< number of these products
  VectorXd cross = VectorXd::Zero(kLags + 1);     ///< of the input and the residual k samples later
  MatrixXd input = MatrixXd::Zero(kLags + 1, kLags + 1);  ///< of inputs at samples with a residual

  void add(const Residuals& residuals, const VectorXd& u) {
    const Index samples = u.size();
    const VectorXd& w = residuals.values;
    for (Index k = 0; k <= std::min<Index>(kLags, samples - 1); ++k) {
      products[k] += w.tail(samples - k).dot(w.head(samples - k));
      pairs[k] += residuals.valid.tail(samples - k).dot(residuals.valid.head(samples - k));
    }
    for (Index t = kLags; t < samples; ++t) {
      if (residuals.valid[t] == 0) continue;
      const VectorXd past = u.segment(t - kLags, kLags + 1).reverse();
      cross += w[t] * past;
      input += past * past.transpose();
    }
  }
};

ResidualTests testsOf(const Sums& sums, int noise_parameters, int plant_parameters) {
  ResidualTests tests;
  if (!(sums.pairs[0] > 2 * kLags) || !(sums.products[0] > 0)) return tests;
  const double variance = sums.products[0] / sums.pairs[0];
  tests.samples = static_cast<long>(sums.pairs[0]);
  double whiteness = 0;
  for (Index k = 1; k <= kLags; ++k) {
    tests.autocorrelation.push_back(sums.products[k] / sums.products[0]);
    const double pairs = std::max(1.0, sums.pairs[k]);
    whiteness += std::pow(sums.products[k] / variance, 2) / pairs;
  }
  for (Index k = 0; k <= kLags; ++k) {
    const double scale = std::sqrt(variance * sums.input(k, k) * sums.pairs[0]);
    tests.cross_correlation.push_back(scale > 0 ? sums.cross[k] / scale : 0);
  }
  // However many parameters were fitted, one degree of freedom is left to test with.
  const double whiteness_degrees = std::max<double>(1, kLags - noise_parameters);
  tests.whiteness_p_value = chiSquaredTail(whiteness, whiteness_degrees, kNone);
  const QuadraticForm dependence = quadraticForm(sums.input, sums.cross, kHardlyMoved);
  const double dependence_degrees =
      dependence.rank - std::min<double>(plant_parameters, dependence.rank - 1);
  tests.independence_p_value =
      chiSquaredTail(dependence.value / variance, std::max(1.0, dependence_degrees), kNone);
  return tests;
}

}  // namespace

ResidualTests residualTests(const Model& model, const std::vector<Block>& blocks,
                            const VectorXd& parameters, int noise_parameters,
                            int plant_parameters) {
  Sums sums;
  for (const Block& block : blocks) {
    Response response;
    model.evaluate(block, parameters, false, &response);
    for (int lane = 0; lane < block.lanes; ++lane) {
      const Index samples = block.lengths[static_cast<std::size_t>(lane)];
      VectorXd u = block.u.row(lane).head(samples).transpose();
      u.array() -= u.mean();
      sums.add(residualsOf(response, block, lane), u);
    }
  }
  return testsOf(sums, noise_parameters, plant_parameters);
}

}  // namespace uncertainty_identification
