#pragma once

#include <vector>

#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// Each so manieth sample suffices: `per_period` a period of the frequency below which 99.5 % of
/// the power of the outputs lies (bandwidth(), median over the experiments), and at least 2,500 in
/// all. At least 1.
int thinningByBandwidth(const std::vector<Experiment>& experiments, double per_period);

/// The experiment with each so manieth sample: inputs and covariates averaged in between, outputs
/// taken at its start, which is exact for inputs that are held.
Experiment thinned(const Experiment& experiment, int thinning);
std::vector<Experiment> thinned(std::vector<Experiment> experiments, int thinning);

}  // namespace uncertainty_identification
