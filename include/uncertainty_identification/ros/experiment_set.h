#pragma once

#include <string>
#include <vector>

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
};

/// From the first sample of the earliest experiment to the last sample of the latest one.
struct TimeWindow {
  double start = 0, end = 0;  ///< [s]
};

/// Both 0 without experiments.
TimeWindow timeWindow(const std::vector<Experiment>& experiments);

/// The experiments that a node identifies from: the newest max_experiments, under ids that differ.
class ExperimentSet {
 public:
  explicit ExperimentSet(const LimitOptions& limits) : limits_(limits) {}

  /// Adds what was read, in order. An id already there gets a number: "run", "run_2", ... Of the
  /// rejected ones the newest max_experiments are remembered.
  void add(LoadedData data);

  const std::vector<Experiment>& experiments() const { return experiments_; }
  const std::vector<RejectedExperiment>& rejected() const { return rejected_; }

  /// Experiments oldest first, then the rejected ones.
  std::vector<ExperimentDigest> digests() const;

 private:
  std::string freeId(const std::string& id) const;

  LimitOptions limits_;
  std::vector<Experiment> experiments_;
  std::vector<RejectedExperiment> rejected_;
};

}  // namespace uncertainty_identification
