#pragma once

#include <vector>

#include "estimation/expectation.h"
#include "model/linear_model.h"

namespace uncertainty_identification {

/// Log density of the first samples of each experiment, which determine its unknown initial values
/// and its own offset [nats].
///
/// Each unknown initial value with its wide prior lowers the log-likelihood by several nats, so
/// that of two structures that describe the data equally well the one with fewer of them would have
/// the higher likelihood. Structures are therefore compared by the log-likelihood less this: by
/// log p(other samples | first samples), which hardly depends on the prior.
double firstSamplesDensity(const LinearModel& model, const ModelParameters& point,
                           const std::vector<Experiment>& experiments, int threads, int* passes);

/// Whether models with these options have unknown values of each experiment's own.
bool hasUnknownsOfExperiments(const EstimationOptions& options);

}  // namespace uncertainty_identification
