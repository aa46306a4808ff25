#pragma once

#include "ros/messages.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {

/// Answers an Identify request: reads its experiments and bags, identifies, and tells errors by
/// code and message instead of throwing. `own` is the node's configuration: its bag_directory
/// counts, and all of it where the request has none. `progress` is called while bags are read too,
/// in the phase "reading bags"; false from it cancels.
messages::Identify::Response answerIdentify(const messages::Identify::Request& request,
                                            const Configuration& own,
                                            const ProgressCallback& progress);

/// The same for a goal of the action IdentifyBags.
messages::IdentifyBagsResult answerIdentifyBags(const messages::IdentifyBagsGoal& goal,
                                                const Configuration& own,
                                                const ProgressCallback& progress);

}  // namespace uncertainty_identification
