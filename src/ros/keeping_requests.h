#pragma once

#include <functional>
#include <optional>

#include "ros/messages.h"
#include "session/reconfiguration.h"
#include "session/saved_experiments.h"

/// Answers to the services that save, load and reconfigure: the session's results and exceptions as
/// messages.
namespace uncertainty_identification {

/// `result` is written into the bag with the experiments.
messages::Save::Response answerSave(const messages::Save::Request& request,
                                    const SavedExperiments& saved,
                                    const std::optional<messages::IdentificationResult>& result);

messages::Load::Response answerLoad(const messages::Load::Request& request,
                                    SavedExperiments& saved);

/// The identification is cancelled when `keep_going` returns false.
messages::Configure::Response answerConfigure(const messages::Configure::Request& request,
                                              Reconfiguration& reconfiguration,
                                              const std::function<bool()>& keep_going);

}  // namespace uncertainty_identification
