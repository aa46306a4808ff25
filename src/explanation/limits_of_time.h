#pragma once

#include <string>
#include <vector>

#include "explanation/split.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/identifier.h"

/// What makes a model of the likelihood simple enough for explanation.time_limit.
namespace uncertainty_identification {

/// Thins records that are sampled far faster than the output moves, where they hold so many samples
/// that the likelihood would take minutes. Returns what was done, as a warning tells it; empty:
/// nothing. The model then has the longer sample time.
std::string thinLongRecords(Split* data);

/// Whether there are more samples than the likelihood can take within the default limit.
bool areMany(const std::vector<Experiment>& experiments);

/// A plant of this order with a noise pole and no other choice.
NominalModelOptions ofOrder(int order);

/// Limits the time of an identification to a share of explanation.time_limit.
void limitTime(double share, Configuration* configuration);

/// The best model that is identified within a share of explanation.time_limit; where none is, that
/// of this order, of which the configuration then is. `remark` says so.
Estimate identifyInTime(double share, int order, const std::vector<Experiment>& experiments,
                        const ProgressCallback& progress, Configuration* configuration,
                        std::string* remark);

}  // namespace uncertainty_identification
