#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "uncertainty_identification/data/signal_timing.h"

namespace uncertainty_identification {

/// One input/output record on a uniform time grid: what was measured in experiment r of the paper's
/// M. Sample k was taken at start_time + k sample_time. Experiments may differ in length.
struct Experiment {
  std::string id;          ///< unique name within a data set
  double sample_time = 0;  ///< [s]
  double start_time = 0;   ///< [s], on the clock of the data's stamps
  Eigen::VectorXd u;  ///< N input samples [unit of the actuator's command], held from k to k + 1
  Eigen::VectorXd y;  ///< N output samples [unit of the sensor]; ignored where `valid` is 0
  std::vector<std::uint8_t> valid;        ///< N flags, 1 = y was measured; empty = all were
  std::map<std::string, double> scalars;  ///< covariates that are constant over the experiment
  std::map<std::string, Eigen::VectorXd> signals;  ///< covariates measured at each sample, N each
  Eigen::VectorXd
      stamp_offset;  ///< N actual minus nominal sampling instants of y [s]; empty = none known
  ExperimentTiming timing;  ///< delays and losses of its samples; not used in the identification

  /// Number of samples N, measured or not.
  int samples() const { return static_cast<int>(u.size()); }

  /// Whether the output was measured at sample k.
  bool isValid(int k) const { return valid.empty() || valid[static_cast<std::size_t>(k)] != 0; }

  /// Number of measured output samples.
  int validSamples() const;
};

}  // namespace uncertainty_identification
