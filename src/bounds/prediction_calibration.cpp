#include "uncertainty_identification/bounds/prediction_calibration.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "estimation/mean_plant.h"
#include "estimation/simulation_fit.h"
#include "math/distributions.h"
#include "math/polynomial.h"
#include "math/random_stream.h"
#include "model/fixed_plant.h"
#include "uncertainty_identification/bounds/plant_distribution.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Simulation errors y - ysim of each experiment.
std::vector<VectorXd> errorsOf(const FoldModel& plant, const EstimationOptions& options,
                               const std::vector<Experiment>& experiments) {
  const auto nominal = fixPlant({plant.delay, plant.b, plant.a, {}, {}}, 0, 0);
  return simulationErrors(*nominal, VectorXd(0), plant.offset, options, experiments);
}

/// The k-th smallest value, k = ceil(level (M + 1)); infinite if there are fewer than k.
double upperQuantile(std::vector<double> values, double level) {
  const auto rank =
      static_cast<std::size_t>(std::ceil(level * (static_cast<double>(values.size()) + 1) - 1e-9));
  if (rank > values.size()) return kInfinite;
  std::nth_element(values.begin(), values.begin() + static_cast<long>(rank) - 1, values.end());
  return values[rank - 1];
}

/// y = q^-delay num/den u from rest. Both polynomials include their leading coefficient.
VectorXd filtered(const VectorXd& num, const VectorXd& den, int delay, const VectorXd& u) {
  VectorXd y = VectorXd::Zero(u.size());
  for (Index t = 0; t < u.size(); ++t) {
    for (Index k = 0; k < num.size() && k + delay <= t; ++k) y[t] += num[k] * u[t - delay - k];
    for (Index k = 1; k < den.size() && k <= t; ++k) y[t] -= den[k] * y[t - k];
  }
  return y;
}

/// The experiment with gaps of the output filled: the simulation is also needed where the output
/// was not measured.
Experiment withoutGaps(const Experiment& experiment) {
  Experiment whole = experiment;
  whole.valid.clear();
  whole.y.setZero(whole.u.size());
  double last = 0;
  for (int t = 0; t < experiment.samples(); ++t) {
    if (experiment.y.size() > 0 && experiment.isValid(t)) last = experiment.y[t];
    whole.y[t] = last;
  }
  return whole;
}

/// Two-sided p-value: probability of a count at least as far from the expected one.
double twoSided(int count, int trials, double probability) {
  const double below = binomialProbability(count, trials, probability);
  const double above = count > 0 ? binomialTail(count - 1, trials, probability) : 1.0;
  return std::min(1.0, 2 * std::min(below, above));
}

void compareWithModel(PredictionCalibration* calibration) {
  constexpr double kSignificant = 0.01;
  const int trials = static_cast<int>(calibration->scores.size());
  for (std::size_t k = 0; k < calibration->model_radius.size(); ++k) {
    const double level = calibration->levels[k];
    int inside = 0;
    for (double score : calibration->scores) inside += score <= calibration->model_radius[k];
    if (twoSided(inside, trials, level) >= kSignificant) continue;
    std::ostringstream message;
    message << "the identified model expects the simulation error of " << 100 * level
            << " % of experiments to stay within " << calibration->model_radius[k]
            << ", but it does so in " << inside << " of " << trials << " held-out experiments"
            << ": the model does not describe their spread; trust the calibrated radius";
    calibration->warnings.push_back(message.str());
    return;  // one warning is enough
  }
}

}  // namespace

double guaranteedCoverage(double level, int experiments, int folds) {
  const double M = experiments, K = folds, alpha = 1 - level;
  const double loss =
      folds >= experiments ? 0 : std::min(2 * (1 - 1 / K) / (M / K + 1), (1 - K / M) / (K + 1));
  return std::max(0.0, 1 - 2 * alpha - loss);
}

void calibrate(const std::vector<double>& levels, PredictionCalibration* calibration) {
  const int experiments = static_cast<int>(calibration->scores.size());
  const int folds = static_cast<int>(calibration->folds.size());
  calibration->method = folds >= experiments ? "jackknife+" : "cv+";
  calibration->levels = levels;
  for (double level : levels) {
    calibration->guaranteed.push_back(guaranteedCoverage(level, experiments, folds));
    calibration->radius.push_back(upperQuantile(calibration->scores, level));
  }
  compareWithModel(calibration);
}

std::vector<double> predictionScores(const FoldModel& plant, const EstimationOptions& options,
                                     const std::vector<Experiment>& experiments) {
  std::vector<double> scores;
  for (const VectorXd& error : errorsOf(plant, options, experiments))
    scores.push_back(error.cwiseAbs().maxCoeff());
  return scores;
}

std::vector<double> expectedScores(const Estimate& estimate,
                                   const std::vector<Experiment>& experiments) {
  constexpr double kMostSamples = 1e6;
  const PlantDistribution plants(estimate);
  const auto uncertainty = plants.hasEstimationErrors() ? Uncertainty::total : Uncertainty::mixture;
  double samples = 1;
  for (const Experiment& experiment : experiments) samples += experiment.samples();
  const int rounds = static_cast<int>(std::min(std::max(kMostSamples / samples, 1.0), 100.0));
  const int count = rounds * static_cast<int>(experiments.size());
  const std::uint64_t seed = estimate.configuration.estimation.seed;
  const TransferFunctions drawn = transferFunctions(plants.draw(count, uncertainty, seed));
  const NominalModelEstimate& go = estimate.nominal_model;
  const VectorXd simulated = meanPlant(estimate).b;
  const VectorXd c = withLeadingOne(go.c), d = withLeadingOne(go.d), a = withLeadingOne(go.a);
  std::vector<double> scores;
  for (int i = 0; i < count; ++i) {
    const Experiment& experiment = experiments[static_cast<std::size_t>(i) % experiments.size()];
    std::mt19937_64 random = randomStream(seed, i, RandomPurpose::noise);
    const VectorXd omega = gaussian(experiment.samples(), estimate.noise_variance.value, random);
    const VectorXd u = experiment.u.array() + estimate.offset_u;
    const VectorXd error =
        filtered(drawn.num.row(i).transpose(), drawn.den.row(i).transpose(), go.delay, u) -
        filtered(simulated, a, go.delay, u) + filtered(c, d, 0, omega);
    double score = 0;
    for (int t = 0; t < experiment.samples(); ++t) {
      if (experiment.isValid(t)) score = std::max(score, std::abs(error[t]));
    }
    scores.push_back(score);
  }
  std::sort(scores.begin(), scores.end());
  return scores;
}

PredictionInterval predictionInterval(const PredictionCalibration& calibration, double level,
                                      const EstimationOptions& options,
                                      const Experiment& experiment) {
  const auto& levels = calibration.levels;
  if (std::find(levels.begin(), levels.end(), level) == levels.end()) {
    std::ostringstream message;
    message << "level: found " << level << "; the prediction was calibrated at";
    for (double one : levels) message << " " << one;
    throw ConfigurationError(message.str());
  }
  const Experiment measured = withoutGaps(experiment);
  std::vector<VectorXd> simulations;
  for (const FoldModel& fold : calibration.folds)
    simulations.push_back(measured.y - errorsOf(fold, options, {measured}).front());
  PredictionInterval interval{VectorXd(measured.y.size()), VectorXd(measured.y.size())};
  std::vector<double> low(calibration.scores.size()), high(low.size());
  for (Index t = 0; t < measured.y.size(); ++t) {
    for (std::size_t r = 0; r < calibration.scores.size(); ++r) {
      const double at = simulations[static_cast<std::size_t>(calibration.fold[r])][t];
      low[r] = -(at - calibration.scores[r]);
      high[r] = at + calibration.scores[r];
    }
    interval.lower[t] = -upperQuantile(low, level);
    interval.upper[t] = upperQuantile(high, level);
  }
  return interval;
}

}  // namespace uncertainty_identification
