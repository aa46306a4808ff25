#include "curves/fit_comparison.h"

#include <algorithm>
#include <cmath>

namespace uncertainty_identification {

double effectiveSamples(const WindowFit& fit) {
  Eigen::Index longest = 0;
  double power = 0, samples = 0;
  for (const Eigen::VectorXd& residual : fit.residuals) {
    longest = std::max(longest, residual.size());
    power += residual.squaredNorm();
    samples += static_cast<double>(residual.size());
  }
  double time = 1;
  for (Eigen::Index lag = 1; lag < std::min<Eigen::Index>(200, longest / 2); ++lag) {
    double product = 0;
    for (const Eigen::VectorXd& residual : fit.residuals) {
      const Eigen::Index pairs = residual.size() - lag;
      if (pairs > 0) product += residual.head(pairs).dot(residual.tail(pairs));
    }
    if (product < 0.05 * power) break;
    time += 2 * product / power;
  }
  return samples / time;
}

double penaltyOf(const WindowFit& fit) { return 1 + 2 * fit.parameters() / effectiveSamples(fit); }

double criterion(const WindowFit& fit, double effective_samples) {
  double samples = 0;
  for (const Eigen::VectorXd& residual : fit.residuals)
    samples += static_cast<double>(residual.size());
  return effective_samples * std::log(fit.squared_error / samples) +
         fit.parameters() * std::log(std::max(effective_samples, 8.0));
}

double pairedT(const Eigen::VectorXd& before, const Eigen::VectorXd& after) {
  const auto t = [](const Eigen::ArrayXd& gains) {
    const auto count = static_cast<double>(gains.size());
    const double mean = gains.mean();
    const double variance = (gains - mean).square().sum() / std::max(count - 1, 1.0);
    return mean / (std::sqrt(variance / count) + 1e-12);
  };
  const Eigen::ArrayXd worse = before.array(), better = after.array();
  return std::max(t(worse - better), t(((worse + 1e-12) / (better + 1e-12)).log()));
}

bool convinces(const Eigen::VectorXd& before, const Eigen::VectorXd& after, std::size_t windows,
               const LeastGain& least) {
  constexpr std::size_t kFew = 4;
  constexpr double kHalf = 0.5;
  if (before.size() == 0) return true;
  const double left = after.sum() / before.sum();
  return (left <= kHalf && windows <= kFew) ||
         (left <= 1 - least.share && pairedT(before, after) >= least.t);
}

bool isSignificant(const WindowFit& fit) {
  constexpr double kErrors = 3;
  const std::vector<Curve>& curves = fit.model.curves;
  const Eigen::ArrayXd errors = fit.covariance.diagonal().array().sqrt();
  Eigen::Index first = fit.model.theta.size();  // the parameters of the curves are the last ones
  return std::all_of(curves.rbegin(), curves.rend(), [&](const Curve& curve) {
    const Eigen::Index count = curve.parameters();
    first -= count;
    const Eigen::ArrayXd values = fit.model.theta.segment(first, count).array();
    return (values.abs() > kErrors * errors.segment(first, count)).any();
  });
}

}  // namespace uncertainty_identification
