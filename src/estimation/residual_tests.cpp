#include "estimation/residual_tests.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>
#include <utility>

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kLags = 20;
constexpr double kUnknown = 1e8;  // prior variance of unknown coefficients, relative to sigma^2
constexpr double kUndetermined = 1e4;  // above this prediction variance a sample gives no residual

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

/// Residuals of an experiment by recursive least squares.
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

double probabilityBeyond(double sum, double degrees) {
  namespace math = boost::math;
  if (!std::isfinite(sum)) return std::numeric_limits<double>::quiet_NaN();
  return cdf(complement(math::chi_squared(std::max(1.0, degrees)), std::max(0.0, sum)));
}

/// x' A^+ x and the rank of A. Directions in which the input hardly varies are left out.
std::pair<double, double> quadraticForm(const MatrixXd& A, const VectorXd& x) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> of_A(A);
  const VectorXd along = of_A.eigenvectors().transpose() * x;
  double sum = 0, rank = 0;
  for (Index k = 0; k < x.size(); ++k) {
    if (of_A.eigenvalues()[k] < 1e-9 * of_A.eigenvalues().maxCoeff()) continue;
    sum += along[k] * along[k] / of_A.eigenvalues()[k];
    ++rank;
  }
  return {sum, rank};
}

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
  tests.whiteness_p_value = probabilityBeyond(whiteness, kLags - noise_parameters);
  const auto [dependence, rank] = quadraticForm(sums.input, sums.cross);
  tests.independence_p_value =
      probabilityBeyond(dependence / variance, rank - std::min<double>(plant_parameters, rank - 1));
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
