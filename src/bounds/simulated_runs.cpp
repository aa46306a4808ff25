#include "uncertainty_identification/bounds/simulated_runs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "data/stray_readings.h"
#include "data/thinning.h"
#include "estimation/mean_plant.h"
#include "estimation/simulation_fit.h"
#include "model/fixed_plant.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kMostPoints = 300;

/// Each interval's least and largest value, in the order of their times; NaN where nothing was
/// measured in it.
VectorXd reduced(const VectorXd& values, Index interval) {
  if (interval == 0) return values;
  const Index count = (values.size() + interval - 1) / interval;
  VectorXd points = VectorXd::Constant(2 * count, std::numeric_limits<double>::quiet_NaN());
  for (Index k = 0; k < count; ++k) {
    Index least = -1, largest = -1;
    for (Index t = k * interval; t < std::min((k + 1) * interval, values.size()); ++t) {
      if (!std::isfinite(values[t])) continue;
      if (least < 0 || values[t] < values[least]) least = t;
      if (largest < 0 || values[t] > values[largest]) largest = t;
    }
    if (least < 0) continue;
    points[2 * k] = values[std::min(least, largest)];
    points[2 * k + 1] = values[std::max(least, largest)];
  }
  return points;
}

/// Samples that two points stand for; 0 where every sample is a point.
Index intervalOf(Index samples) {
  return samples <= kMostPoints ? 0 : (2 * samples + kMostPoints - 1) / kMostPoints;
}

void addPrediction(const PredictionCalibration& calibration, const EstimationOptions& options,
                   const Experiment& experiment, Index interval, SimulatedRun* run) {
  const auto& levels = calibration.levels;
  if (levels.empty()) return;
  run->level = std::count(levels.begin(), levels.end(), 0.95) > 0 ? 0.95 : levels.back();
  const PredictionInterval limits =
      predictionInterval(calibration, run->level, options, experiment);
  if (!limits.lower.allFinite() || !limits.upper.allFinite()) return;
  run->lower = reduced(limits.lower, interval);
  run->upper = reduced(limits.upper, interval);
}

/// A set of experiments and their free simulations, from the state that fits the first samples as
/// in Validation.
class Simulations {
 public:
  Simulations(const Estimate& estimate, const std::vector<Experiment>& experiments)
      : options_(estimate.configuration.estimation), experiments_(experiments) {
    if (options_.initial_state != InitialState::zero)
      options_.initial_state = InitialState::estimate;
    const auto nominal = fixPlant(meanPlant(estimate), 0, 0);
    const double offset =
        options_.offset_side == OffsetSide::input ? estimate.offset_u : estimate.offset_y;
    errors_ = simulationErrors(*nominal, VectorXd(0), offset, options_, experiments);
    fits_ = simulationFit(*nominal, VectorXd(0), offset, options_, experiments).percent;
  }

  /// Indices from the best fit to the worst; a constant output, which has no fit, comes last.
  std::vector<std::size_t> ranked() const {
    std::vector<std::size_t> order(fits_.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    const auto value = [this](std::size_t k) {
      return std::isfinite(fits_[k]) ? fits_[k] : -1e300;
    };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t one, std::size_t other) { return value(one) > value(other); });
    return order;
  }

  SimulatedRun run(std::size_t k, const std::string& rank, bool validation,
                   const PredictionCalibration* calibration) const {
    const Experiment& experiment = experiments_[k];
    VectorXd measured = experiment.y;
    for (int t = 0; t < experiment.samples(); ++t) {
      if (!experiment.isValid(t)) measured[t] = std::numeric_limits<double>::quiet_NaN();
    }
    const Index interval = intervalOf(measured.size());
    SimulatedRun run{experiment.id, rank, validation, fits_[k], experiment.sample_time};
    if (interval > 0) run.time_step *= static_cast<double>(interval) / 2;
    run.measured = reduced(measured, interval);
    run.simulated = reduced(measured - errors_[k], interval);
    if (calibration != nullptr) addPrediction(*calibration, options_, experiment, interval, &run);
    return run;
  }

 private:
  EstimationOptions options_;
  const std::vector<Experiment>& experiments_;
  std::vector<VectorXd> errors_;
  std::vector<double> fits_;
};

void addRuns(const Simulations& all, bool validation, const PredictionCalibration* calibration,
             std::vector<SimulatedRun>* runs) {
  const std::vector<std::size_t> order = all.ranked();
  const std::size_t count = order.size();
  if (count > 0) runs->push_back(all.run(order[0], "best", validation, calibration));
  if (count > 2) runs->push_back(all.run(order[count / 2], "median", validation, calibration));
  if (count > 1) runs->push_back(all.run(order[count - 1], "worst", validation, calibration));
}

/// The experiments of these names at the estimate's sample time.
std::vector<Experiment> chosen(const std::vector<Experiment>& experiments,
                               const std::set<std::string>& ids) {
  std::vector<Experiment> own;
  for (const Experiment& experiment : experiments) {
    if (ids.count(experiment.id) > 0) own.push_back(experiment);
  }
  return own;
}

}  // namespace

std::vector<SimulatedRun> simulatedRuns(const Estimate& estimate,
                                        const PredictionCalibration* calibration,
                                        const std::vector<Experiment>& training,
                                        const std::vector<Experiment>& validation) {
  std::set<std::string> used,
      held_out(estimate.validation.experiments.begin(), estimate.validation.experiments.end());
  for (const ExperimentEstimate& experiment : estimate.experiments) used.insert(experiment.id);
  const int thinning = estimate.configuration.estimation.thinning;
  const double most = estimate.configuration.limits.max_stray;
  std::vector<Experiment> fitted = chosen(training, used), others = chosen(validation, held_out);
  const StrayReadings stray = strayReadings(fitted, most),
                      stray_others = strayReadings(others, most, stray.count > 0);
  fitted = thinned(without(stray, std::move(fitted)), thinning);
  others = thinned(without(stray_others, std::move(others)), thinning);
  std::vector<SimulatedRun> runs;
  if (!fitted.empty()) addRuns(Simulations(estimate, fitted), false, calibration, &runs);
  if (!others.empty()) addRuns(Simulations(estimate, others), true, calibration, &runs);
  return runs;
}

}  // namespace uncertainty_identification
