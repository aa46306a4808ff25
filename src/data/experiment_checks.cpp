#include "data/experiment_checks.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "data/text.h"

// Checks that compare experiments with each other; single_experiment_checks.cpp checks each by
// itself.
namespace uncertainty_identification {
namespace {

constexpr double kSampleTimeTolerance = 1e-3;  // relative

bool sameSampleTime(double one, double other) {
  return std::abs(one - other) <= kSampleTimeTolerance * std::max(std::abs(one), std::abs(other));
}

/// The sample time that most experiments share. If two are equally frequent, the one with more
/// samples in total.
double commonSampleTime(const std::vector<Experiment>& experiments,
                        const std::vector<int>& candidates) {
  std::vector<std::pair<double, long>> sorted;  // sample time, samples
  for (const int i : candidates) {
    const Experiment& experiment = experiments[static_cast<std::size_t>(i)];
    sorted.emplace_back(experiment.sample_time, experiment.samples());
  }
  std::sort(sorted.begin(), sorted.end());
  double common = 0;
  std::pair<std::size_t, long> most{0, 0};  // experiments, samples
  long samples = 0;
  for (std::size_t first = 0, last = 0; first < sorted.size(); ++first) {
    for (; last < sorted.size() && sameSampleTime(sorted[first].first, sorted[last].first);
         ++last) {
      samples += sorted[last].second;
    }
    const std::pair<std::size_t, long> found{last - first, samples};
    if (found > most) {
      most = found;
      common = sorted[first + (last - first) / 2].first;
    }
    samples -= sorted[first].second;
  }
  return common;
}

class Checker {
 public:
  explicit Checker(const std::vector<Experiment>& experiments) : experiments_(experiments) {}

  void checkEach(const LimitOptions& limits, const std::vector<std::string>& required_covariates) {
    for (std::size_t i = 0; i < experiments_.size(); ++i) {
      for (Finding& finding : checkExperiment(experiments_[i], limits, required_covariates)) {
        if (finding.only_alone) {
          constant_inputs_.emplace_back(i, std::move(finding.message));
        } else if (finding.rejects) {
          reject(i, finding.message);
        } else {
          report_.warnings.push_back(std::move(finding.message));
        }
      }
    }
  }

  /// Those with a constant input are of use beside one that has another input and is itself used.
  void checkConstantInputs(const std::vector<Experiment>& beside) {
    const std::vector<int> candidates = accepted();
    std::vector<std::size_t> used;
    for (auto& [i, message] : constant_inputs_) {
      const double level = experiments_[i].u(0);
      const auto is_another = [&](const Experiment& other) {
        return (other.u.array() != level).any();
      };
      const bool is_of_use = std::any_of(beside.begin(), beside.end(), is_another) ||
                             std::any_of(candidates.begin(), candidates.end(), [&](int other) {
                               return is_another(experiments_[static_cast<std::size_t>(other)]);
                             });
      if (is_of_use)
        used.push_back(i);
      else
        reject(i, message);
    }
    if (used.empty()) return;
    report_.warnings.push_back(
        firstOf(used.size(), used.front()) +
        ": the input is constant from the first sample on; where it was switched on just then, at "
        "rest, this is a step, otherwise it shows the gain only");
  }

  void checkIds() {
    std::set<std::string> ids;
    for (const int i : accepted()) {
      const std::string& id = experiments_[static_cast<std::size_t>(i)].id;
      if (ids.insert(id).second) continue;
      reject(static_cast<std::size_t>(i),
             named(id) +
                 ": an earlier experiment has the same id and is used instead; "
                 "give every experiment an id of its own");
    }
  }

  void checkSampleTimes(double sample_time) {
    const bool given = sample_time > 0;
    const double common = given ? sample_time : commonSampleTime(experiments_, accepted());
    for (const int i : accepted()) {
      const Experiment& experiment = experiments_[static_cast<std::size_t>(i)];
      if (sameSampleTime(experiment.sample_time, common)) continue;
      reject(static_cast<std::size_t>(i),
             named(experiment.id) + ": its sample time is " + text(experiment.sample_time) +
                 " s, but " + (given ? "sample_time is set to " : "most experiments have ") +
                 text(common) +
                 " s; record all experiments at one rate, or set sample_time so that they are "
                 "resampled when read");
    }
  }

  void checkExcitation() {
    const std::vector<int> usable = accepted();
    const auto single = [&](int i) {
      return isSingleStep(experiments_[static_cast<std::size_t>(i)]);
    };
    if (usable.empty() || !std::all_of(usable.begin(), usable.end(), single)) return;
    report_.single_steps = true;
    report_.warnings.push_back(
        firstOf(usable.size(), static_cast<std::size_t>(usable.front())) +
        ": the input changes only once, and a single step excites little beyond low "
        "frequencies; record several steps or a random binary sequence");
  }

  CheckReport report() {
    report_.usable = accepted();
    for (const auto& [i, reason] : reasons_)
      report_.rejected.push_back({experiments_[i].id, reason});
    return std::move(report_);
  }

 private:
  /// So many experiments, by the name of the first.
  std::string firstOf(std::size_t count, std::size_t first) const {
    const std::string others = count == 1 ? "" : " and " + std::to_string(count - 1) + " other";
    return named(experiments_[first].id) + others + (count > 2 ? "s" : "");
  }

  void reject(std::size_t i, const std::string& message) {
    std::string& reason = reasons_[i];
    reason += (reason.empty() ? "" : "; ") + message;
  }

  std::vector<int> accepted() const {
    std::vector<int> indices;
    for (std::size_t i = 0; i < experiments_.size(); ++i) {
      if (reasons_.count(i) == 0) indices.push_back(static_cast<int>(i));
    }
    return indices;
  }

  const std::vector<Experiment>& experiments_;
  std::map<std::size_t, std::string> reasons_;  ///< by index of the experiment
  std::vector<std::pair<std::size_t, std::string>> constant_inputs_;  ///< and why not alone
  CheckReport report_;
};

}  // namespace

bool isSingleStep(const Experiment& experiment) {
  int changes = 0;
  for (Eigen::Index k = 1; k < experiment.u.size() && changes < 2; ++k) {
    if (experiment.u(k) != experiment.u(k - 1)) ++changes;
  }
  return changes < 2;
}

std::string reasonsOf(const std::vector<RejectedExperiment>& rejected) {
  std::string reasons;
  for (const RejectedExperiment& each : rejected) reasons += "\n  " + each.reason;
  return reasons;
}

CheckReport checkExperiments(const std::vector<Experiment>& experiments, const LimitOptions& limits,
                             const std::vector<std::string>& required_covariates,
                             double sample_time, const std::vector<Experiment>& beside) {
  Checker checker(experiments);
  checker.checkEach(limits, required_covariates);
  checker.checkConstantInputs(beside);
  checker.checkIds();
  checker.checkSampleTimes(sample_time);
  checker.checkExcitation();
  return checker.report();
}

}  // namespace uncertainty_identification
