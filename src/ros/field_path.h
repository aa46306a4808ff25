#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ros/message_definition.h"

namespace uncertainty_identification {

/// One component of a resolved path: a field of a message type and, for arrays, the element.
struct FieldStep {
  std::size_t field = 0;    ///< index within its message type
  std::uint32_t index = 0;  ///< of the array element; 0 if the field is not an array
  /// Name of the array element, which is looked up in each message; empty: it is given by number.
  std::string element = {};
  std::size_t names = 0;  ///< index of the field that lists the names, within the message type
};

/// The path from a message to one of the numbers in it.
struct FieldPath {
  std::string text;              ///< the resolved path, e.g. "effort[0]"
  std::vector<FieldStep> steps;  ///< from the root to the number, at least one
};

/// The index of the field `name` that lists the names of the elements of the other arrays, as in a
/// sensor_msgs/JointState; nothing if the message type has none.
std::optional<std::size_t> namesField(const MessageType& type);

/// Resolves a path as described at MessageDecoder. Throws ConfigurationError when there is no such
/// field, or when "auto" finds none or several. The message lists the numeric fields, the most
/// similar names first.
FieldPath resolveFieldPath(const MessageDefinition& definition, const std::string& path,
                           const std::string& topic);

}  // namespace uncertainty_identification
