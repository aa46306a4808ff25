#include "explanation/intervals.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;

constexpr double kNinety = 1.6449;  // two-sided normal quantile
constexpr double kDrop = 1.3528;    // half the 90 % quantile of chi-squared, one degree of freedom

CauseParameter normalInterval(CauseParameter of, double standard_error) {
  of.standard_error = standard_error;
  of.lower_90 = of.value - kNinety * standard_error;
  of.upper_90 = of.value + kNinety * standard_error;
  return of;
}

/// Interval of a standard deviation, whose logarithm is normal: `log_error` is the standard error
/// of the log-variance.
CauseParameter deviationInterval(CauseParameter of, double log_error) {
  const double relative = 0.5 * log_error;
  of.standard_error = of.value * relative;
  of.lower_90 = of.value * std::exp(-kNinety * relative);
  of.upper_90 = of.value * std::exp(kNinety * relative);
  return of;
}

/// Bisection for the ends of the interval in which the log-likelihood drops by less than kDrop.
CauseParameter likelihoodInterval(CauseParameter of, const Fit& fit, const FitData& data, int at,
                                  double scale) {
  constexpr int kHalvings = 18;
  const auto reach = [&](double direction) {
    double inside = 0, outside = direction * 0.2 * scale;
    for (int step = 0; step < kHalvings; ++step) {
      const double middle = 0.5 * (inside + outside);
      ModelParameters moved = fit.at;
      moved.parameters[at] += middle;
      const double drop = fit.log_likelihood - evaluated(fit.model, moved, data).log_likelihood;
      (drop < kDrop ? inside : outside) = middle;
    }
    return inside;
  };
  of.lower_90 = of.value + reach(-1);
  of.upper_90 = of.value + reach(1);
  of.standard_error = (of.upper_90 - of.lower_90) / (2 * kNinety);
  return of;
}

MatrixXd covarianceOf(const Fit& fit, const FitData& data) {
  const Likelihood likelihood(*fit.model, data.blocks(), data.count(), 1);
  const Expectation expectation =
      likelihood.expect(likelihood.statistics(fit.at.parameters, false), fit.at);
  return likelihood.information(fit.at, latentMoments(expectation))
      .observed.completeOrthogonalDecomposition()
      .pseudoInverse();
}

}  // namespace

std::vector<CauseParameter> parametersOf(const Fit& fit, const FitData& data,
                                         const std::shared_ptr<const Effect>& effect) {
  const auto& effects = fit.model->effects();
  const auto found = std::find(effects.begin(), effects.end(), effect);
  if (found == effects.end()) return {};
  const int first = fit.model->offsetOf(static_cast<std::size_t>(found - effects.begin()));
  const MatrixXd covariance = covarianceOf(fit, data);
  std::vector<CauseParameter> all;
  for (int i = 0; i < effect->parameterCount(); ++i) {
    const EffectParameter& of = effect->description().parameters[static_cast<std::size_t>(i)];
    const int at = first + i;
    const double value = toReported(of, fit.at.parameters[at], fit.at.noise_variance);
    const CauseParameter bare{of.name, of.unit, value, 0, 0, 0};
    const double error = std::sqrt(std::max(covariance(at, at), 0.0));
    if (of.log_variance) {
      all.push_back(deviationInterval(bare, error));
    } else if (of.smooth && error > 0) {
      all.push_back(normalInterval(bare, error));
    } else {
      all.push_back(likelihoodInterval(bare, fit, data, at, of.scale));
    }
  }
  return all;
}

}  // namespace uncertainty_identification
