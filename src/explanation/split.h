#pragma once

#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// Experiments to fit to and to measure with.
struct Split {
  std::vector<Experiment> train, held;
  bool fitted_to = false;  ///< there are too few to keep any out: held are those of train
};

/// `validation` is held out; where there is none, a share of the experiments drawn by the
/// configuration's seed. Fewer than four experiments are measured on themselves.
Split split(const Configuration& configuration, const std::vector<Experiment>& experiments,
            const std::vector<Experiment>& validation);

}  // namespace uncertainty_identification
