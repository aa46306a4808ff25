#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "session/experiment_files.h"
#include "session/experiment_set.h"
#include "session/stored_result.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/rejected_experiment.h"

namespace uncertainty_identification {

/// A configuration set by ~configure, and the parameters that the node had at that time.
struct StoredConfiguration {
  Configuration configuration, parameters;
};

/// What a store holds when a node starts.
struct StoredState {
  std::vector<KeptExperiment> kept;          ///< the newest experiments, oldest first
  std::vector<RejectedExperiment> rejected;  ///< the newest rejected ones
  std::uint64_t last_number = 0;             ///< largest number of any experiment in the store
  int count = 0;  ///< number of experiments in the store, including those not in `kept`
  std::optional<StoredResult> result;
  std::optional<StoredConfiguration> configuration;
  std::vector<std::string> warnings;  ///< which files were damaged, and where they were moved
};

/// The folder in which a node keeps its experiments and its result:
///
///   current/experiment_00000001.bag  one file per experiment, written by ExperimentFiles
///   current/result.json              the last result, as the tool `identify` writes it, with the
///                                    time of its publication
///   current/rejected/                rejected experiments, each with its reason in a .json file
///   current/damaged/                 files that could not be read, each with the reason
///   reset_1/, reset_2/, ...          what was in current/ before each ~reset
///   configuration.json               what ~configure set
///   saved/                           what ~save wrote (SavedExperiments)
///
/// Every file appears complete and on the disk, or not at all. No experiment and no result is ever
/// deleted; the store removes only temporary files and the oldest reasons of recordings that gave
/// no experiment.
///
/// All functions throw FileError when the operating system refuses; the call can then be repeated.
/// A store must not be used by several threads at the same time.
class ExperimentStore {
 public:
  /// Creates the folder if necessary and locks it. Throws ConfigurationError when that fails or
  /// when another node uses the folder.
  ExperimentStore(const std::string& directory, ExperimentFiles files);
  ~ExperimentStore();

  ExperimentStore(const ExperimentStore&) = delete;
  ExperimentStore& operator=(const ExperimentStore&) = delete;

  /// Reads what the store holds. Of the experiments it reads the newest ones, until it has
  /// limits.max_experiments that are usable (defectOf) or as many that are not. Damaged files are
  /// moved to current/damaged/.
  StoredState load(const LimitOptions& limits);

  void write(const KeptExperiment& experiment);
  void write(const StoredResult& result);
  void write(const StoredConfiguration& configuration);

  /// Moves an experiment to current/rejected/.
  void reject(std::uint64_t number, const RejectedExperiment& rejected);

  /// Records why a recording gave no experiment, and keeps the newest `max_count` such reasons.
  void reject(const RejectedExperiment& rejected, int max_count);

  /// Renames current/ to reset_<number>/, so that the store is empty.
  void reset();

 private:
  std::string fileName(std::uint64_t number) const;
  void loadExperiments(const LimitOptions& limits, StoredState& state);
  void loadRejected(int max_count, StoredState& state);
  Experiment readOne(const std::string& path) const;
  void finishRejections();
  void moveDamaged(const std::string& path, const std::string& reason, StoredState& state);

  std::string directory_, current_;
  ExperimentFiles files_;
  int lock_;                          // file descriptor of the locked folder
  std::uint64_t last_rejection_ = 0;  // number of the newest reason without an experiment
};

}  // namespace uncertainty_identification
