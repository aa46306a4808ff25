#include "uncertainty_identification/ros/experiment_set.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace uncertainty_identification {
namespace {

template <typename Item>
void keepNewest(std::vector<Item>& items, int count) {
  const auto excess = static_cast<std::ptrdiff_t>(items.size()) - std::max(1, count);
  if (excess > 0) items.erase(items.begin(), items.begin() + excess);
}

}  // namespace

TimeWindow timeWindow(const std::vector<Experiment>& experiments) {
  if (experiments.empty()) return {};
  TimeWindow window{std::numeric_limits<double>::infinity(),
                    -std::numeric_limits<double>::infinity()};
  for (const auto& experiment : experiments) {
    const double duration = std::max(0, experiment.samples() - 1) * experiment.sample_time;
    window.start = std::min(window.start, experiment.start_time);
    window.end = std::max(window.end, experiment.start_time + duration);
  }
  return window;
}

void ExperimentSet::add(LoadedData data) {
  for (auto& experiment : data.experiments) {
    experiment.id = freeId(experiment.id);
    experiments_.push_back(std::move(experiment));
  }
  for (auto& rejected : data.rejected) rejected_.push_back(std::move(rejected));
  keepNewest(experiments_, limits_.max_experiments);
  keepNewest(rejected_, limits_.max_experiments);
}

std::string ExperimentSet::freeId(const std::string& id) const {
  const auto taken = [this](const std::string& candidate) {
    return std::any_of(experiments_.begin(), experiments_.end(),
                       [&](const Experiment& experiment) { return experiment.id == candidate; });
  };
  std::string candidate = id;
  for (int number = 2; taken(candidate); ++number) candidate = id + "_" + std::to_string(number);
  return candidate;
}

std::vector<ExperimentDigest> ExperimentSet::digests() const {
  std::vector<ExperimentDigest> digests;
  for (const auto& experiment : experiments_)
    digests.push_back({experiment.id, experiment.start_time, experiment.sample_time,
                       experiment.validSamples(), ""});
  for (const auto& rejected : rejected_) digests.push_back({rejected.id, 0, 0, 0, rejected.reason});
  return digests;
}

}  // namespace uncertainty_identification
