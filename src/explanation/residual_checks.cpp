#include "explanation/residual_checks.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "explanation/input_features.h"
#include "math/constants.h"
#include "residual_tests/test_statistics.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kTimeBins = 10;     // over an experiment
constexpr double kUndefined = 1;  // p-value of a statistic that cannot be computed: it passes

Check check(const std::string& name, double statistic, double p_value, const std::string& where) {
  const bool passed = !(p_value < kCheckThreshold);
  return {name, statistic, p_value, passed, passed ? "" : where};
}

/// The sum of all samples of all experiments.
double total(const std::vector<Signals>& signals) {
  double sum = 0;
  for (const Signals& signal : signals) sum += signal.sum();
  return sum;
}

std::vector<Signals> weights(const FitData& data) {
  std::vector<Signals> all;
  for (const Block& block : data.blocks()) all.push_back(block.weight);
  return all;
}

/// The residual, scaled to variance 1, and its squares minus their mean, scaled to variance 1.
/// Large squares are cut, so that no single sample decides a test.
struct ScaledResidual {
  std::vector<Signals> residual, square;
  double samples, skewness, kurtosis;
};

ScaledResidual scaled(const Residuals& residuals, const FitData& data) {
  constexpr double kLargestSquare = 12;
  ScaledResidual all{residuals.standardised, {}, total(weights(data)), 0, 0};
  double power = 0;
  for (const Signals& signal : all.residual) power += signal.square().sum();
  for (Signals& signal : all.residual) signal *= std::sqrt(all.samples / std::max(power, 1e-300));
  double mean = 0, spread = 0;
  for (const Signals& signal : all.residual) {
    all.square.push_back(signal.square().min(kLargestSquare));
    mean += all.square.back().sum() / all.samples;
    all.skewness += signal.cube().sum() / all.samples;
    all.kurtosis += signal.square().square().sum() / all.samples;
  }
  for (std::size_t b = 0; b < all.square.size(); ++b) {
    all.square[b] = (all.square[b] - mean) * data.blocks()[b].weight;
    spread += all.square[b].square().sum() / all.samples;
  }
  for (Signals& signal : all.square) signal /= std::sqrt(std::max(spread, 1e-300));
  all.kurtosis -= 3;
  return all;
}

/// The time that a bin of scaledTimeBins() covers, in words.
std::string timeRange(Index bin, const FitData& data) {
  const double duration = data.blocks().front().samples * data.experiments().front().sample_time;
  std::ostringstream text;
  text.precision(3);
  text << "from " << duration * static_cast<double>(bin) / kTimeBins << " s to "
       << duration * static_cast<double>(bin + 1) / kTimeBins << " s of each experiment";
  return text.str();
}

/// A score test: whether any linear combination of the whitened features explains part of the
/// residual.
Check featureCheck(const Fit& fit, const FitData& data, const ScaledResidual& of) {
  constexpr double kCollinear = 1e-6;  // relative eigenvalue of features that depend on each other
  const FeatureProducts products = featureProducts(fit, data, of.residual);
  const VectorXd scale = products.gram.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const MatrixXd unit = scale.asDiagonal() * products.gram * scale.asDiagonal();
  const VectorXd single = scale.cwiseProduct(products.cross);
  const QuadraticForm score = quadraticForm(unit, single, kCollinear);
  Index strongest = 0;
  single.cwiseAbs().maxCoeff(&strongest);
  return check("dependence on the input", score.value,
               chiSquaredTail(score.value, score.rank, kUndefined),
               "strongest with " + products.names[static_cast<std::size_t>(strongest)]);
}

/// The frequency at which the spectrum of the residual differs most from a white one's, in words.
/// The spectrum is that of the correlations, scaled as scaledCorrelations() returns them.
std::string frequencyBand(const VectorXd& correlation, double samples, double sample_time) {
  constexpr int kPoints = 50;
  double largest = 0;
  int at = 0;
  for (int i = 1; i < kPoints; ++i) {
    double power = 0;
    for (Index k = 0; k < correlation.size(); ++k)
      power += 2 * correlation[k] / std::sqrt(samples) *
               std::cos(kPi * i / kPoints * static_cast<double>(k + 1));
    if (std::abs(power) > std::abs(largest)) largest = power, at = i;
  }
  std::ostringstream text;
  text.precision(3);
  text << (largest > 0 ? "too much" : "too little") << " power around "
       << kPi * at / kPoints / sample_time << " rad/s";
  return text.str();
}

Check whitenessCheck(const ScaledResidual& of, double sample_time) {
  constexpr int kLags = 12;
  const VectorXd white = scaledCorrelations(of.residual, kLags, of.samples);
  return check("whiteness", white.squaredNorm(),
               chiSquaredTail(white.squaredNorm(), kLags, kUndefined),
               frequencyBand(white, of.samples, sample_time));
}

Check timeCheck(const ScaledResidual& of, const FitData& data) {
  const VectorXd bins = scaledTimeBins(of.square, data.blocks(), kTimeBins);
  Index bin = 0;
  bins.cwiseAbs().maxCoeff(&bin);
  return check("variance over time", bins.squaredNorm(),
               chiSquaredTail(bins.squaredNorm(), kTimeBins - 1, kUndefined), timeRange(bin, data));
}

/// Whether large residuals follow each other.
Check volatilityCheck(const ScaledResidual& of) {
  constexpr int kLags = 5;
  const VectorXd squares = scaledCorrelations(of.square, kLags, of.samples);
  return check("volatility", squares.squaredNorm(),
               chiSquaredTail(squares.squaredNorm(), kLags, kUndefined), "large residuals cluster");
}

/// Whether the variance of the residual differs between experiments.
Check experimentCheck(const ScaledResidual& of, const FitData& data) {
  double sum = 0, largest = 0;
  std::string worst;
  for (std::size_t b = 0; b < of.square.size(); ++b) {
    const Block& block = data.blocks()[b];
    for (int lane = 0; lane < block.lanes; ++lane) {
      const double z =
          of.square[b].row(lane).sum() / std::sqrt(std::max(1.0, block.weight.row(lane).sum()));
      sum += z * z;
      if (std::abs(z) <= largest) continue;
      largest = std::abs(z);
      worst = block.experiments[static_cast<std::size_t>(lane)]->id;
    }
  }
  return check("variance over experiments", sum,
               chiSquaredTail(sum, std::max(1, data.count() - 1), kUndefined),
               "strongest in " + worst);
}

}  // namespace

std::vector<Check> checkResiduals(const Fit& fit, const FitData& data, ResidualLaw law) {
  const ScaledResidual of = scaled(residualsOf(fit, data), data);
  const double sample_time = data.experiments().front().sample_time;
  std::vector<Check> checks{whitenessCheck(of, sample_time), featureCheck(fit, data, of),
                            timeCheck(of, data)};
  if (law != ResidualLaw::of_steps) checks.push_back(volatilityCheck(of));
  if (law != ResidualLaw::gaussian) return checks;
  // For N Gaussian samples the kurtosis has variance 24/N. The third moment has 15/N, as it is
  // taken about zero, where the model says that the mean is, and not about the sample mean.
  const double tails = of.kurtosis / std::sqrt(24 / of.samples);
  checks.push_back(check("tails", of.kurtosis, twoSidedNormalTail(tails),
                         tails > 0 ? "too many large residuals" : "too few large residuals"));
  const double skew = of.skewness / std::sqrt(15 / of.samples);
  checks.push_back(
      check("symmetry", of.skewness, twoSidedNormalTail(skew),
            skew > 0 ? "large residuals are positive" : "large residuals are negative"));
  checks.push_back(experimentCheck(of, data));
  return checks;
}

bool allPassed(const std::vector<Check>& checks) {
  return std::all_of(checks.begin(), checks.end(), [](const Check& check) { return check.passed; });
}

}  // namespace uncertainty_identification
