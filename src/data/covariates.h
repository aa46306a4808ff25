#pragma once

#include <string>

#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/data/recording.h"

namespace uncertainty_identification {

/// Stores a covariate given at each sample: as a scalar if it is constant, otherwise as a signal.
void addCovariate(const std::string& name, Eigen::VectorXd values, Experiment& experiment);

/// Adds a recording's covariates. At each of `instants` [s] the value is that of the last finite
/// sample so far, or of the first one if none has come yet. A covariate without finite samples is
/// left out. Throws DataError for bad stamps.
void addCovariates(const Recording& recording, const std::vector<double>& instants,
                   Experiment& experiment);

}  // namespace uncertainty_identification
