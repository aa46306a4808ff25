#pragma once

#include <functional>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/ros/messages.h"

namespace uncertainty_identification {

/// Answers an Identify request: reads its experiments and bags, identifies, and tells errors by
/// code and message instead of throwing. `own` is the node's configuration: its bag_directory
/// counts, and all of it where the request has none. The identification is cancelled when
/// `keep_going` returns false.
messages::Identify::Response answerIdentify(const messages::Identify::Request& request,
                                            const Configuration& own,
                                            const std::function<bool()>& keep_going);

}  // namespace uncertainty_identification
