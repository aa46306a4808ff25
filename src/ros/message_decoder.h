#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "ros/field_path.h"
#include "ros/message_definition.h"

namespace uncertainty_identification {

/// A serialised ROS message: bytes owned by someone else, little endian as on the wire.
struct SerialisedMessage {
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;  ///< [bytes]
};

/// Walks through the whole message. Throws DataError when it is shorter than the definition and the
/// lengths in it say.
void requireComplete(const MessageDefinition& definition, SerialisedMessage message);

/// Reads one number out of serialised messages of one type. Built once per connection; reading
/// allocates nothing and never leaves the buffer, whatever it holds.
class MessageDecoder {
 public:
  /// `path` names a numeric field, "twist.twist.linear.x", "effort[0]" (all builtin types but
  /// string are numeric; time and duration are read in seconds), or is "auto": the only numeric
  /// field outside a std_msgs/Header. A first component that is no field but the last part of the
  /// topic's name or the type's name is passed over, so that "joint_states.effort[0]" reads
  /// "effort[0]" of the topic /joint_states. Throws ConfigurationError that lists the numeric
  /// fields, nearest first, when there is no such field.
  MessageDecoder(std::shared_ptr<const MessageDefinition> definition, const std::string& path,
                 const std::string& topic);

  /// The value, true as 1. Throws DataError when the message is shorter than its definition says or
  /// has no element of that index.
  double value(SerialisedMessage message) const;

  /// Whether messages carry a stamp of their own: they begin with a std_msgs/Header.
  bool hasStamp() const { return definition_->hasHeader(); }

  /// Stamp of the leading header [s]. Requires hasStamp(). Throws DataError as above.
  double stamp(SerialisedMessage message) const;

  /// Sequence number of the leading header. Requires hasStamp(). Throws DataError as above.
  std::uint32_t sequence(SerialisedMessage message) const;

  /// The path as resolved, "effort[0]".
  const std::string& path() const { return path_.text; }

 private:
  std::shared_ptr<const MessageDefinition> definition_;
  FieldPath path_;
};

}  // namespace uncertainty_identification
