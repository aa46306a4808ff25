#pragma once

#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/data/rejected_experiment.h"

namespace uncertainty_identification {

/// A data split: experiments to fit to, and held-out experiments to measure gains on.
struct Split {
  std::vector<Experiment> train, held;
  bool fitted_to = false;  ///< too few experiments to hold any out: `held` are those of `train`
};

/// Holds out `validation`. If it is empty, a share of the experiments
/// (explanation.validation_share) is drawn with the configuration's seed and held out; of fewer
/// than four experiments none.
Split split(const Configuration& configuration, const std::vector<Experiment>& experiments,
            const std::vector<Experiment>& validation);

/// Leaves out the experiments that `identify` refuses as well, e.g. those whose sample time is not
/// that of most experiments to fit to; returns them with the reasons.
/// @throws DataError if there are none left to fit to, or none to hold out.
std::vector<RejectedExperiment> leaveOutUnusable(const Configuration& configuration, Split* data);

/// The split of those that are usable: without `validation`, held-out experiments are drawn among
/// them. Adds those that are left out to `rejected`.
/// @throws DataError if there are none left to fit to, or none to hold out.
Split splitUsable(const Configuration& configuration, const std::vector<Experiment>& experiments,
                  const std::vector<Experiment>& validation,
                  std::vector<RejectedExperiment>* rejected);

}  // namespace uncertainty_identification
