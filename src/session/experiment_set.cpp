#include "session/experiment_set.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "data/check.h"

namespace uncertainty_identification {
namespace {

template <typename Item>
void dropOldestBeyond(int count, std::vector<Item>& items) {
  const auto excess = static_cast<std::ptrdiff_t>(items.size()) - std::max(1, count);
  if (excess > 0) items.erase(items.begin(), items.begin() + excess);
}

}  // namespace

ExperimentWindow windowOf(const std::vector<Experiment>& experiments) {
  if (experiments.empty()) return {};
  ExperimentWindow window{static_cast<int>(experiments.size()), experiments.front().id,
                          experiments.back().id, std::numeric_limits<double>::infinity(),
                          -std::numeric_limits<double>::infinity()};
  for (const auto& experiment : experiments) {
    const double duration = std::max(0, experiment.samples() - 1) * experiment.sample_time;
    window.start = std::min(window.start, experiment.start_time);
    window.end = std::max(window.end, experiment.start_time + duration);
  }
  return window;
}

void ExperimentSet::restore(std::vector<KeptExperiment> kept,
                            std::vector<RejectedExperiment> rejected, std::uint64_t last_number) {
  kept_.clear();
  for (auto& experiment : kept) {
    recorded_before_.add(*experiment.experiment);
    const std::string id = unusedId(experiment.experiment->id);
    // The id is in use if it was given to another experiment after this one had left the set.
    if (id != experiment.experiment->id) {
      Experiment renamed = *experiment.experiment;
      renamed.id = id;
      experiment.experiment = std::make_shared<const Experiment>(std::move(renamed));
    }
    check(experiment);
    kept_.push_back(std::move(experiment));
  }
  rejected_ = std::move(rejected);
  last_number_ = last_number;
  dropOldest();
}

std::vector<KeptExperiment> ExperimentSet::add(LoadedData data) {
  std::vector<KeptExperiment> added;
  for (auto& experiment : data.experiments) {
    if (!recorded_before_.add(experiment)) continue;
    experiment.id = unusedId(experiment.id);
    kept_.push_back({++last_number_, std::make_shared<const Experiment>(std::move(experiment))});
    check(kept_.back());
    added.push_back(kept_.back());
  }
  for (auto& rejected : data.rejected) rejected_.push_back(std::move(rejected));
  dropOldest();
  return added;
}

std::optional<std::uint64_t> ExperimentSet::reject(const std::string& id,
                                                   const std::string& reason) {
  const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const KeptExperiment& kept) {
    return kept.experiment->id == id;
  });
  if (found == kept_.end()) return std::nullopt;
  recorded_before_.takeOut(*found->experiment);
  const std::uint64_t number = found->number;
  kept_.erase(found);
  rejected_.push_back({id, reason});
  dropOldest();
  return number;
}

void ExperimentSet::clear() {
  recorded_before_.clear();
  kept_.clear();
  rejected_.clear();
}

void ExperimentSet::setLimits(const LimitOptions& limits) {
  limits_ = limits;
  for (auto& kept : kept_) check(kept);
  dropOldest();
}

void ExperimentSet::check(KeptExperiment& kept) const {
  kept.defect = defectOf(*kept.experiment, limits_);
}

void ExperimentSet::dropOldest() {
  int usable = 0, unusable = 0;
  const auto exceeds = [&](const KeptExperiment& kept) {
    return ++(kept.defect.empty() ? usable : unusable) > std::max(1, limits_.max_experiments);
  };
  for (auto kept = kept_.end(); kept != kept_.begin();) {
    --kept;
    if (exceeds(*kept)) kept = kept_.erase(kept);
  }
  dropOldestBeyond(limits_.max_experiments, rejected_);
}

std::string ExperimentSet::unusedId(const std::string& id) const {
  const auto in_use = [this](const std::string& candidate) {
    return std::any_of(kept_.begin(), kept_.end(), [&](const KeptExperiment& kept) {
      return kept.experiment->id == candidate;
    });
  };
  std::string candidate = id;
  for (int number = 2; in_use(candidate); ++number) candidate = id + "_" + std::to_string(number);
  return candidate;
}

std::vector<ExperimentDigest> ExperimentSet::digests() const {
  std::vector<ExperimentDigest> digests;
  for (const auto& kept : kept_) {
    const Experiment& experiment = *kept.experiment;
    digests.push_back({experiment.id, experiment.start_time, experiment.sample_time,
                       experiment.validSamples(), kept.defect, experiment.timing});
  }
  for (const auto& rejected : rejected_) digests.push_back({rejected.id, 0, 0, 0, rejected.reason});
  return digests;
}

}  // namespace uncertainty_identification
