#pragma once

#include "ros/messages.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {

/// Identifies from the experiments and bags of a request. Errors become the answer's code and
/// message; nothing is thrown. `own` is the node's configuration: it is used when the request has
/// no configuration, and bags are always read from its bag_directory. `progress` is called while
/// bags are read as well (phase "reading bags"); when it returns false, the work is cancelled.
messages::Identify::Response answerIdentify(const messages::Identify::Request& request,
                                            const Configuration& own,
                                            const ProgressCallback& progress);

/// The same for a goal of the action IdentifyBags.
messages::IdentifyBagsResult answerIdentifyBags(const messages::IdentifyBagsGoal& goal,
                                                const Configuration& own,
                                                const ProgressCallback& progress);

}  // namespace uncertainty_identification
