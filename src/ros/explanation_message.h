#pragma once

#include <cstdint>

#include "ros/messages.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// An explanation as a message, which also contains explanation.json as text. `sequence` is the
/// number of the result that it belongs to; 0 means none.
messages::Explanation toMessage(const Explanation& explanation, const ros::Time& stamp,
                                std::uint32_t sequence);

}  // namespace uncertainty_identification
