#pragma once

#include "ros/message_conversions.h"
#include "ros/messages.h"
#include "uncertainty_identification/bounds/bounds.h"

namespace uncertainty_identification {

/// Bounds of a result as a message: those that count the estimate's errors where they are known.
messages::UncertaintyBounds toMessage(const Bounds& bounds, const ResultContext& context);

/// Answers a request for plants drawn from `estimate` (null: there is none yet).
messages::SampleModels::Response answerSampleModels(const messages::SampleModels::Request& request,
                                                    const Estimate* estimate,
                                                    std::uint32_t sequence);

}  // namespace uncertainty_identification
