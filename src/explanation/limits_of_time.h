#pragma once

#include <string>

#include "explanation/split.h"
#include "uncertainty_identification/configuration.h"

/// What makes a model of the likelihood simple enough for explanation.time_limit.
namespace uncertainty_identification {

/// Thins records that are sampled far faster than the output moves, where they hold so many samples
/// that the likelihood would take minutes. Returns what was done, as a warning tells it; empty:
/// nothing. The model then has the longer sample time.
std::string thinLongRecords(Split* data);

/// A plant of this order with a noise pole and no other choice.
NominalModelOptions ofOrder(int order);

}  // namespace uncertainty_identification
