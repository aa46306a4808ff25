#pragma once

#include <cstdint>

#include "ros/experiment_set.h"
#include "ros/messages.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/estimation/estimate.h"

/// Between the package's types and its messages: the only place where one becomes the other.
namespace uncertainty_identification {

/// Where a result stands among those of a node.
struct ResultContext {
  ros::Time stamp;
  std::uint32_t sequence = 0;
  bool preliminary = false;
  ExperimentWindow window;  ///< of the experiments given
};

/// Throws DataError when the start time does not fit a stamp (before 1970, after 2106).
messages::Experiment toMessage(const Experiment& experiment);

/// Throws DataError, naming the experiment and the field, when sizes disagree, a covariate's kind
/// is unknown or its name is empty or given twice, a name has more than 200 characters, or the
/// times of its samples do not fit stamps. Also when it has more than limits.max_samples.
Experiment fromMessage(const messages::Experiment& message, const LimitOptions& limits = {});

/// The start is 0 for what was rejected before it had samples.
messages::ExperimentSummary toMessage(const ExperimentDigest& digest);

/// The parts of an estimate as messages.
messages::NominalModel toNominalModelMessage(const Estimate& estimate,
                                             const ResultContext& context);
messages::ErrorModel toErrorModelMessage(const Estimate& estimate, const ResultContext& context);

/// The whole, with result.json and the configuration as text.
messages::IdentificationResult toMessage(const Estimate& estimate, const ResultContext& context);

/// The termination as IdentificationResult and IdentificationStatus state it.
std::uint8_t toMessage(Termination termination);

/// A stamp, rounded to its resolution of 1 ns. Throws DataError, beginning with `what`, for seconds
/// that do not fit.
ros::Time toStamp(double seconds, const std::string& what);

}  // namespace uncertainty_identification
