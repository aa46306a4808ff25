#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ros/message_definition.h"

namespace uncertainty_identification {

/// One component of a resolved path: a field of a message type, and for arrays the element.
struct FieldStep {
  std::size_t field = 0;    ///< index within its message type
  std::uint32_t index = 0;  ///< of the element; 0 where the field is no array
};

/// The way from a message to one number in it.
struct FieldPath {
  std::string text;              ///< as resolved, "effort[0]"
  std::vector<FieldStep> steps;  ///< from the root to the number, at least one
};

/// Resolves a path as MessageDecoder documents it. Throws ConfigurationError that lists the numeric
/// fields, nearest first, when there is no such field, or when "auto" finds none or several.
FieldPath resolveFieldPath(const MessageDefinition& definition, const std::string& path,
                           const std::string& topic);

}  // namespace uncertainty_identification
