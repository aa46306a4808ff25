#include "support/hidden_effects/effect_strength.h"

#include <Eigen/Cholesky>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/digamma.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "math/constants.h"
#include "math/polynomial.h"
#include "simulation/signals.h"
#include "simulation/simulate.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification::test {
namespace {

using Eigen::VectorXd;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Variance of a signal over all experiments; signal(experiment) returns it.
template <class Signal>
double variance(const std::vector<Experiment>& experiments, Signal signal) {
  double sum = 0, squares = 0, count = 0;
  for (const Experiment& experiment : experiments) {
    const VectorXd& values = signal(experiment);
    sum += values.sum();
    squares += values.squaredNorm();
    count += static_cast<double>(values.size());
  }
  return squares / count - std::pow(sum / count, 2);
}

const VectorXd& inputOf(const Experiment& experiment) { return experiment.u; }
const VectorXd& outputOf(const Experiment& experiment) { return experiment.y; }

/// Log-likelihood per sample that a Gaussian model gains when it uses the variance of each sample
/// instead of their mean. A common factor of the variances makes no difference.
double gainOfVariances(const std::vector<double>& variances) {
  double mean = 0, mean_log = 0;
  for (const double each : variances) {
    mean += each / static_cast<double>(variances.size());
    mean_log += std::log(each) / static_cast<double>(variances.size());
  }
  return 0.5 * (std::log(mean) - mean_log);
}

/// Entropy of the normal distribution minus that of Student's t of the same variance.
double gainOfTails(double degrees) {
  const double half = degrees / 2;
  const double entropy =
      (half + 0.5) * (boost::math::digamma(half + 0.5) - boost::math::digamma(half)) +
      std::log(std::sqrt(degrees) * boost::math::beta(half, 0.5)) +
      0.5 * std::log((degrees - 2) / degrees);
  return 0.5 * std::log(2 * kPi) + 0.5 - entropy;
}

/// The noise is w/(D E), where E is the additional colour. A model that does not know E uses the
/// best D' of the order of D. Its prediction errors D'/(D E) w have more than the variance of w;
/// half the logarithm of the ratio is the gain. D' is a linear least-squares fit to the impulse
/// response of 1/(D E).
double gainOfColour(const Truth& truth) {
  constexpr int kSamples = 2000;
  const auto& colour = *truth.effects.noise.colour;
  const VectorXd d = multiply(truth.noise.d, Eigen::Vector2d(colour.d1, colour.d2));
  const VectorXd response = filtered(VectorXd::Ones(1), d, 0, VectorXd::Unit(kSamples, 0).eval());
  const Eigen::Index order = truth.noise.d.size();
  const auto autocovariance = [&](Eigen::Index lag) {
    return response.head(kSamples - lag).dot(response.tail(kSamples - lag));
  };
  if (order == 0) return 0.5 * std::log(autocovariance(0));
  Eigen::MatrixXd R(order, order);
  VectorXd r(order);
  for (Eigen::Index i = 0; i < order; ++i) {
    r(i) = autocovariance(i + 1);
    for (Eigen::Index j = 0; j < order; ++j) R(i, j) = autocovariance(std::abs(i - j));
  }
  return 0.5 * std::log(autocovariance(0) - r.dot(R.ldlt().solve(r)));
}

}  // namespace

EffectStrength::EffectStrength(std::string name, const Truth& without, std::uint64_t seed)
    : name_(std::move(name)), seed_(seed), without_(simulate(without, seed)) {
  Truth quiet = without;
  quiet.noise.variance = 0;
  output_variance_ = variance(simulate(quiet, seed), outputOf);
  input_variance_ = variance(without_, inputOf);
}

double EffectStrength::operator()(const Truth& with) const {
  const NoiseEffects& noise = with.effects.noise;
  if (name_ == "noise_tails") return gainOfTails(noise.tails->degrees_of_freedom);
  if (name_ == "noise_colour") return gainOfColour(with);
  if (name_ == "noise_step" || name_ == "noise_hetero") return varianceGain(with);
  try {
    return name_ == "exp_feedback" ? loopCorrelation(with) : outputShare(with);
  } catch (const ConfigurationError&) {  // the output diverges
    return kInfinite;
  }
}

double EffectStrength::outputShare(const Truth& with) const {
  double squares = 0, count = 0;
  for (int r = 0; r < with.experiments; ++r) {
    const VectorXd& plain = without_[static_cast<std::size_t>(r)].y;
    squares += (simulateExperiment(with, seed_, r).y - plain).squaredNorm();
    count += static_cast<double>(plain.size());
  }
  return squares / count / output_variance_;
}

double EffectStrength::loopCorrelation(const Truth& with) const {
  const double closed = variance(simulate(with, seed_), inputOf);
  if (closed > 3 * input_variance_) return kInfinite;
  return with.effects.experiment.feedback->gain * std::sqrt(with.noise.variance / closed);
}

double EffectStrength::varianceGain(const Truth& with) const {
  std::vector<double> variances;
  const NoiseEffects& noise = with.effects.noise;
  Truth quiet = with;
  quiet.noise.variance = 0;
  for (int r = 0; r < with.experiments; ++r) {
    const Experiment experiment = simulateExperiment(quiet, seed_, r);
    for (int k = 0; k < experiment.samples(); ++k) {
      if (noise.step) {
        variances.push_back(std::pow(noise.step->ratio, 2 * onset(k, noise.step->start)));
      } else {
        const bool of_input = noise.hetero->driver == HeteroDriver::input;
        const double driver = (of_input ? experiment.u(k) : experiment.y(k)) / noise.hetero->scale;
        variances.push_back(1 - noise.hetero->share + noise.hetero->share * driver * driver);
      }
    }
  }
  return gainOfVariances(variances);
}

}  // namespace uncertainty_identification::test
