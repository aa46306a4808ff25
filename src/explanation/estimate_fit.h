#pragma once

#include "explanation/fit.h"
#include "uncertainty_identification/estimation/estimate.h"

/// Between estimates, which users see, and fits, which a search works with.
namespace uncertainty_identification {

/// The experiments of `all` that the estimate rests on, in their order.
std::vector<Experiment> usedBy(const Estimate& estimate, std::vector<Experiment> all);

/// The model of an estimate, ready to be extended, for the same experiments.
Fit fitOf(const Estimate& estimate, const FitData& data, const DataSummary& summary);

/// The estimate of an extended fit, by the Identifier from there on: what a configuration with
/// these effects gives.
Estimate estimateOf(const Fit& fit, const FitData& data, const Estimate& base);

}  // namespace uncertainty_identification
