#pragma once

#include "ros/message_conversions.h"
#include "ros/messages.h"
#include "uncertainty_identification/bounds/bounds.h"

namespace uncertainty_identification {

/// The bounds of a result as a message. If the estimation errors are known, these are the bounds
/// that include them.
messages::UncertaintyBounds toMessage(const Bounds& bounds, const ResultContext& context);

/// Answers a request for plants drawn from `estimate`; null means that there is no result yet.
messages::SampleModels::Response answerSampleModels(const messages::SampleModels::Request& request,
                                                    const Estimate* estimate,
                                                    std::uint32_t sequence);

}  // namespace uncertainty_identification
