#include "own_simulation/compared_runs.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

constexpr std::size_t kFewestUnits = 10;
constexpr std::size_t kMostKept = 10000000;  ///< samples of outputs that are kept: 80 MB

ComparedRun comparedRun(const Experiment& experiment, double begin, double end,
                        std::size_t experiments) {
  ComparedRun run;
  run.experiment = &experiment;
  const int samples = experiment.samples();
  const int first = static_cast<int>(begin * samples), last = static_cast<int>(end * samples);
  run.weight = Eigen::ArrayXd::Zero(samples);
  for (int k = first; k < last; ++k)
    run.weight[k] = experiment.isValid(k) && std::isfinite(experiment.y[k]) ? 1 : 0;
  const int parts = static_cast<int>((kFewestUnits + experiments - 1) / experiments);
  for (int part = 0; part <= parts; ++part)
    run.blocks.push_back(first + part * (last - first) / parts);
  return run;
}

}  // namespace

int ComparedData::samples() const {
  double sum = 0;
  for (const ComparedRun& run : runs) sum += run.weight.sum();
  return static_cast<int>(sum);
}

double ComparedData::power() const {
  double count = 0, sum = 0, squares = 0;
  for (const ComparedRun& run : runs)
    for (Eigen::Index k = 0; k < run.weight.size(); ++k) {
      if (run.weight[k] == 0) continue;
      const double y = run.experiment->y[k];
      count += 1;
      sum += y;
      squares += y * y;
    }
  return std::max(squares - sum * sum / std::max(count, 1.0), 0.0);
}

double ComparedData::fitOf(double squared_error) const {
  return 100 * (1 - std::sqrt(squared_error / std::max(power(), 1e-300)));
}

ComparedData comparedData(const std::vector<Experiment>& experiments, double begin, double end) {
  ComparedData data;
  for (const Experiment& experiment : experiments)
    data.runs.push_back(comparedRun(experiment, begin, end, experiments.size()));
  return data;
}

Eigen::VectorXd SimulationRuns::valuesOf(const std::vector<SimulationParameter>& parameters) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t k = 0; k < parameters.size(); ++k)
    values[static_cast<Eigen::Index>(k)] = parameters[k].value;
  return values;
}

const Eigen::VectorXd& SimulationRuns::output(const ComparedRun& run,
                                              const Eigen::VectorXd& values) {
  const Key key{run.experiment, {values.data(), values.data() + values.size()}};
  const auto known = kept_.find(key);
  if (known != kept_.end()) return known->second;
  const Experiment& experiment = *run.experiment;
  Eigen::VectorXd y = simulation_.run(inputOf(experiment), values);
  ++count_;
  const std::string where = simulation_.description() + ", experiment '" + experiment.id + "': ";
  if (y.size() != experiment.samples())
    throw DataError(where + "it returned " + std::to_string(y.size()) + " samples for " +
                    std::to_string(experiment.samples()) + " samples of the input");
  if (values == own_values_ && !y.allFinite()) {
    Eigen::Index k = 0;
    while (std::isfinite(y[k])) ++k;
    throw DataError(where + "sample " + std::to_string(k) +
                    " of its output is not a finite number; check the simulation with this input");
  }
  kept_samples_ += static_cast<std::size_t>(y.size());
  if (kept_samples_ > kMostKept) {
    kept_.clear();
    kept_samples_ = static_cast<std::size_t>(y.size());
  }
  return kept_[key] = std::move(y);
}

void SimulationRuns::allow(int most) {
  most_ = most;
  ended_early_ = false;
}

bool SimulationRuns::affords(std::size_t further) {
  cancelled_ = cancelled_ || (keep_going_ && !keep_going_(count_));
  if (simulation_.canRerun() && count_ + static_cast<int>(further) > most_) ended_early_ = true;
  return !endedEarly();
}

}  // namespace uncertainty_identification
