#pragma once

#include <string>

#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/data/recording.h"

namespace uncertainty_identification {

/// Stores a covariate given at each sample: as a scalar where it is constant, else as a signal.
void addCovariate(const std::string& name, Eigen::VectorXd values, Experiment& experiment);

/// Adds a recording's covariates, each held from its last finite sample at or before `instants` [s]
/// (before its first sample: that one). A covariate without finite samples is left out. Throws
/// DataError for bad stamps.
void addCovariates(const Recording& recording, const std::vector<double>& instants,
                   Experiment& experiment);

}  // namespace uncertainty_identification
