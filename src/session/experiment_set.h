#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "data/recorded_before.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/data/loaded_data.h"

namespace uncertainty_identification {

/// One line in the list of a node's experiments.
struct ExperimentDigest {
  std::string id;
  double start = 0;        ///< [s]
  double sample_time = 0;  ///< [s]
  int samples = 0;         ///< number of measured output samples
  std::string rejected;    ///< why the experiment is not used; empty when it is used
  ExperimentTiming timing = {};
};

/// The experiments that were given to one identification.
struct ExperimentWindow {
  int count = 0;
  std::string first_id, last_id;
  double start = 0;  ///< [s] first sample of the experiment that began first
  double end = 0;    ///< [s] last sample of the experiment that ended last
};

/// All members are 0 or empty when there are no experiments.
ExperimentWindow windowOf(const std::vector<Experiment>& experiments);

/// An experiment of a node with its number. Numbers are unique and rise in order of arrival.
struct KeptExperiment {
  std::uint64_t number = 0;
  std::shared_ptr<const Experiment> experiment;
  std::string defect = {};  ///< why it cannot be used (defectOf); empty when it can
};

/// The experiments that a node identifies from.
///
/// The set holds the newest limits.max_experiments usable experiments (those without a defectOf),
/// and up to as many unusable ones: users are told why, and an unusable experiment can become
/// usable when the limits change. All ids in the set are different.
class ExperimentSet {
 public:
  explicit ExperimentSet(const LimitOptions& limits) : limits_(limits) {}

  /// Replaces the content by experiments that were kept earlier and have numbers. Experiments added
  /// later get numbers above `last_number`.
  void restore(std::vector<KeptExperiment> kept, std::vector<RejectedExperiment> rejected,
               std::uint64_t last_number);

  /// Adds experiments in order and returns those that are new, with their numbers. Experiments that
  /// were recorded before (RecordedBefore) are left out, also when the set no longer holds them. If
  /// an id is in use, the new experiment's id gets a number: "run", "run_2", ... Of the rejected
  /// experiments in `data` the newest max_experiments are remembered.
  std::vector<KeptExperiment> add(LoadedData data);

  /// Removes an experiment and lists it as rejected for this reason. Returns its number, or nothing
  /// when the set has no experiment of this id.
  std::optional<std::uint64_t> reject(const std::string& id, const std::string& reason);

  /// Call this before add() for an experiment that a user asks to add. Returns whether add() will
  /// accept it: it was not recorded before, or it was removed by reject() since.
  bool readmit(const Experiment& experiment) { return recorded_before_.readmit(experiment); }

  /// Removes everything. Numbers go on rising.
  void clear();

  /// Checks all experiments against other limits.
  void setLimits(const LimitOptions& limits);

  const std::vector<KeptExperiment>& kept() const { return kept_; }
  const std::vector<RejectedExperiment>& rejected() const { return rejected_; }

  /// The experiments of the set, oldest first, followed by the rejected ones.
  std::vector<ExperimentDigest> digests() const;

 private:
  std::string unusedId(const std::string& id) const;
  void check(KeptExperiment& kept) const;
  void dropOldest();

  LimitOptions limits_;
  RecordedBefore recorded_before_;
  std::uint64_t last_number_ = 0;
  std::vector<KeptExperiment> kept_;
  std::vector<RejectedExperiment> rejected_;
};

}  // namespace uncertainty_identification
