#pragma once

#include <string>
#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/data/rejected_experiment.h"

namespace uncertainty_identification {

/// One thing a user should know about an experiment.
struct Finding {
  std::string experiment;   ///< id
  bool rejects = false;     ///< whether the experiment is left out because of it
  std::string message;      ///< which experiment, what was found, what to record instead
  bool only_alone = false;  ///< rejects it only where no other experiment has another input
};

/// Which experiments a fit may use, and why not the others.
struct CheckReport {
  std::vector<int> usable;  ///< indices into the experiments checked, rising
  std::vector<RejectedExperiment>
      rejected;  ///< in order; several reasons of one experiment are joined
  std::vector<std::string> warnings;
  bool single_steps = false;  ///< whether every usable input changes only once
};

/// Findings about one experiment by itself. It is rejected for fewer than two samples; fewer than
/// min_samples measured outputs; u, y, valid, covariates or stamp_offset of unequal length; a
/// sample time that is not positive; a non-finite u, measured y or required covariate; a constant
/// input or output; a share of missing outputs above max_missing; a required covariate that is
/// absent. A non-finite covariate that is not required is a warning, and so is an output that wraps
/// as an angle does.
std::vector<Finding> checkExperiment(const Experiment& experiment, const LimitOptions& limits,
                                     const std::vector<std::string>& required_covariates);

/// Why checkExperiment rejects the experiment whatever the others are, when no covariates are
/// required; several reasons are joined. Empty: it does not.
std::string defectOf(const Experiment& experiment, const LimitOptions& limits);

/// Whether the input changes at most once. A single step excites slow dynamics only: soon after it,
/// the signals are constant and add no information.
bool isSingleStep(const Experiment& experiment);

/// Checks all experiments before a fit. Beyond checkExperiment: a second experiment of the same id
/// is rejected, and so is one whose sample time differs by more than a thousandth from
/// `sample_time` [s] (0: from that of most experiments). An experiment whose input is constant, but
/// not zero, is used, with a warning, where another one, of these or of those `beside` them, has
/// another input: steps are often recorded from the moment on at which they are applied. `beside`:
/// those that a model is fitted to, where these validate it. There is a warning if every usable
/// input is a single step.
CheckReport checkExperiments(const std::vector<Experiment>& experiments, const LimitOptions& limits,
                             const std::vector<std::string>& required_covariates,
                             double sample_time, const std::vector<Experiment>& beside = {});

/// The reasons of all rejections, each on an indented line of its own.
std::string reasonsOf(const std::vector<RejectedExperiment>& rejected);

/// A hash (64-bit FNV-1a, 16 hexadecimal digits) of all that determines a fit: sample times, u,
/// valid, measured y, and covariates, but neither ids nor start times. It does not depend on the
/// order of the experiments.
std::string dataFingerprint(const std::vector<Experiment>& experiments);

}  // namespace uncertainty_identification
