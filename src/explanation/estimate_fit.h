#pragma once

#include "explanation/fit.h"
#include "uncertainty_identification/estimation/estimate.h"

/// Conversion between estimates, which users see, and fits, which the search for causes works with.
namespace uncertainty_identification {

/// The experiments of `all` from which the estimate was made, in the same order.
std::vector<Experiment> usedBy(const Estimate& estimate, std::vector<Experiment> all);

/// The model of an estimate as one that effects can be added to, evaluated on its experiments.
/// Where Go was fitted to its simulation (nominal_model.fit: simulation), it is held there, and C
/// and D are the only parameters of the linear model.
Fit fitOf(const Estimate& estimate, const FitData& data, const DataSummary& summary);

/// The estimate of a fit with effects. The Identifier optimises it from the fit's point, so that it
/// equals what a configuration with these effects gives, unless it needs more than `iterations`.
Estimate estimateOf(const Fit& fit, const FitData& data, const Estimate& base, int iterations);

}  // namespace uncertainty_identification
