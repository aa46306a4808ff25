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

/// One experiment in a list of them.
struct ExperimentDigest {
  std::string id;
  double start = 0;        ///< [s]
  double sample_time = 0;  ///< [s]
  int samples = 0;         ///< measured output samples
  std::string rejected;    ///< why it is not used; empty: it is
  ExperimentTiming timing = {};
};

/// The experiments that a result was asked of: how many, the first and the last of them, and from
/// the first sample of the earliest one to the last sample of the latest one.
struct ExperimentWindow {
  int count = 0;
  std::string first_id, last_id;
  double start = 0, end = 0;  ///< [s]
};

/// All 0 and empty without experiments.
ExperimentWindow windowOf(const std::vector<Experiment>& experiments);

/// An experiment under a number that no other one of the node has, rising in order of arrival.
struct KeptExperiment {
  std::uint64_t number = 0;
  std::shared_ptr<const Experiment> experiment;
  std::string defect = {};  ///< why it cannot be used (defectOf); empty: it can
};

/// The experiments that a node identifies from: the newest max_experiments of those that pass the
/// checks (defectOf), and among them no more that do not, which are kept to tell of them and in
/// case the limits change. Under ids that differ.
class ExperimentSet {
 public:
  explicit ExperimentSet(const LimitOptions& limits) : limits_(limits) {}

  /// Takes up what was kept before, numbered already; numbers given from now on are above `last`.
  void restore(std::vector<KeptExperiment> kept, std::vector<RejectedExperiment> rejected,
               std::uint64_t last);

  /// Adds what was read, in order, and returns it as it is kept, without what was recorded before
  /// (RecordedBefore), be it no longer among those kept. An id already there gets a number:
  /// "run", "run_2", ... Of the rejected ones the newest max_experiments are remembered.
  std::vector<KeptExperiment> add(LoadedData data);

  /// Takes an experiment out, for a reason; its number, or nothing where there is no such one.
  std::optional<std::uint64_t> reject(const std::string& id, const std::string& reason);

  /// Whether an experiment that is asked for will be added: it was not recorded before, or was
  /// rejected since.
  bool readmit(const Experiment& experiment) { return recorded_before_.readmit(experiment); }

  /// Forgets all but the numbers.
  void clear();

  void setLimits(const LimitOptions& limits);

  const std::vector<KeptExperiment>& kept() const { return kept_; }
  const std::vector<RejectedExperiment>& rejected() const { return rejected_; }

  /// Experiments oldest first, then the rejected ones.
  std::vector<ExperimentDigest> digests() const;

 private:
  std::string freeId(const std::string& id) const;
  void judge(KeptExperiment& kept) const;
  void keepNewest();

  LimitOptions limits_;
  RecordedBefore recorded_before_;
  std::uint64_t last_number_ = 0;
  std::vector<KeptExperiment> kept_;
  std::vector<RejectedExperiment> rejected_;
};

}  // namespace uncertainty_identification
