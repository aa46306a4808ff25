#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ros/experiment_set.h"
#include "ros/stored_result.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/rejected_experiment.h"

namespace uncertainty_identification {

/// A configuration that ~configure set, and the parameters that the node had then.
struct StoredConfiguration {
  Configuration configuration, parameters;
};

/// What a store holds of the time before.
struct StoredState {
  std::vector<KeptExperiment> kept;          ///< the newest ones, oldest first
  std::vector<RejectedExperiment> rejected;  ///< the newest ones
  std::uint64_t last_number = 0;             ///< that an experiment has
  int count = 0;                             ///< experiments, those not in `kept` too
  std::optional<StoredResult> result;
  std::optional<StoredConfiguration> configuration;
  std::vector<std::string> warnings;  ///< what was damaged, and where it is now
};

/// A folder that a node keeps what it learns in. Each file appears complete and on the disk, or not
/// at all; nothing is ever deleted but temporary files and reasons of what had no samples:
///
///   current/experiment_00000001.bag  one bag with one message of type Experiment each
///   current/result.json              the last result, as identify writes it, and when it was found
///   current/rejected/                bags taken out, with the reason beside each
///   current/damaged/                 files that could not be read, with the reason beside each
///   reset_1/, reset_2/, ...          what was current before each ~reset
///   configuration.json               what ~configure set
///   saved/                           what ~save wrote
///
/// All functions throw FileError when the system refuses; what they were to write can be tried
/// again. Not to be used from several threads at once.
class ExperimentStore {
 public:
  /// Creates the folder if need be and locks it. Throws ConfigurationError when that cannot be
  /// done, or another node uses it.
  explicit ExperimentStore(const std::string& directory);
  ~ExperimentStore();

  ExperimentStore(const ExperimentStore&) = delete;
  ExperimentStore& operator=(const ExperimentStore&) = delete;

  /// Reads the newest experiments, limits.max_experiments usable ones (defectOf) and no more of the
  /// others, and what else there is; moves aside what is damaged.
  StoredState load(const LimitOptions& limits);

  void write(const KeptExperiment& experiment);
  void write(const StoredResult& result);
  void write(const StoredConfiguration& configuration);

  /// Moves an experiment to the rejected ones.
  void reject(std::uint64_t number, const RejectedExperiment& rejected);

  /// Remembers the newest `most` of those that had no samples.
  void reject(const RejectedExperiment& rejected, int most);

  /// Puts all experiments and the result into a folder of their own, and begins anew.
  void reset();

 private:
  std::string bagName(std::uint64_t number) const;
  void loadExperiments(const LimitOptions& limits, StoredState& state);
  void loadRejected(int most, StoredState& state);
  void finishRejections();
  void moveDamaged(const std::string& path, const std::string& reason, StoredState& state);

  std::string directory_, current_;
  int lock_;
  std::uint64_t last_rejection_ = 0;
};

}  // namespace uncertainty_identification
