#pragma once

#include <string>
#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/data/rejected_experiment.h"

namespace uncertainty_identification {

/// One thing a user should know about an experiment.
struct Finding {
  std::string experiment;  ///< id
  bool rejects = false;    ///< whether the experiment is left out because of it
  std::string message;     ///< which experiment, what was found, what to record instead
};

/// Which experiments a fit may use, and why not the others.
struct CheckReport {
  std::vector<int> usable;  ///< indices into the experiments checked, rising
  std::vector<RejectedExperiment>
      rejected;  ///< in order; several reasons of one experiment are joined
  std::vector<std::string> warnings;
};

/// Findings about one experiment by itself: no samples or one; fewer than min_samples measured; u,
/// y, valid, covariates or stamp_offset of unequal length; sample time not positive; a non-finite
/// u, measured y or covariate; constant input or output; more than max_missing of the output
/// missing; a required covariate absent. A covariate that is not required but not finite is a
/// warning.
std::vector<Finding> checkExperiment(const Experiment& experiment, const LimitOptions& limits,
                                     const std::vector<std::string>& required_covariates);

/// Why checkExperiment rejects the experiment, whatever covariates a model may require; several
/// reasons are joined. Empty: it does not.
std::string defectOf(const Experiment& experiment, const LimitOptions& limits);

/// Checks all experiments before a fit. Beyond checkExperiment: a second experiment of the same id
/// is rejected, and one whose sample time departs by more than a thousandth from `sample_time` [s]
/// (0: from that of most experiments). A warning where no usable input does more than a single
/// step.
CheckReport checkExperiments(const std::vector<Experiment>& experiments, const LimitOptions& limits,
                             const std::vector<std::string>& required_covariates,
                             double sample_time);

/// 16 hexadecimal digits (64-bit FNV-1a) of what determines a fit: sample times, u, valid, y where
/// it was measured, and covariates; neither ids nor start times. Independent of the order of the
/// experiments.
std::string dataFingerprint(const std::vector<Experiment>& experiments);

}  // namespace uncertainty_identification
