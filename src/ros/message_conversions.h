#pragma once

#include <cstdint>

#include "ros/messages.h"
#include "session/result_context.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/estimation/estimate.h"

/// Conversions between the package's types and its messages. There are no others elsewhere.
namespace uncertainty_identification {

/// Throws DataError when the start time does not fit a stamp (before 1970, after 2106).
messages::Experiment toMessage(const Experiment& experiment);

/// Throws DataError, naming the experiment and the field, when sizes disagree, a covariate's kind
/// is unknown or its name is empty or given twice, a name has more than 200 characters, the times
/// of the samples do not fit ROS stamps, or there are more than limits.max_samples samples.
Experiment fromMessage(const messages::Experiment& message, const LimitOptions& limits = {});

/// The start is 0 for a recording that was rejected before it became an experiment.
messages::ExperimentSummary toMessage(const ExperimentDigest& digest);

/// The time at which a result was published first.
ros::Time stampOf(const ResultContext& context);

/// The parts of an estimate as messages.
messages::NominalModel toNominalModelMessage(const Estimate& estimate,
                                             const ResultContext& context);
messages::ErrorModel toErrorModelMessage(const Estimate& estimate, const ResultContext& context);

/// The whole estimate, with result.json and the configuration as text.
messages::IdentificationResult toMessage(const Estimate& estimate, const ResultContext& context);

/// The constant for a termination in IdentificationResult and IdentificationStatus.
std::uint8_t toMessage(Termination termination);

/// A ROS stamp, rounded to 1 ns. Throws DataError for seconds outside the range of ROS stamps; the
/// message begins with `what`.
ros::Time toStamp(double seconds, const std::string& what);

}  // namespace uncertainty_identification
