#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "ros/field_path.h"
#include "ros/message_definition.h"

namespace uncertainty_identification {

/// A view of a serialised ROS message, little endian as on the wire. The bytes are owned by the
/// caller.
struct SerialisedMessage {
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;  ///< [bytes]
};

/// Checks a message from front to back. Throws DataError when it has fewer bytes than its
/// definition and the array lengths in it need.
void requireComplete(const MessageDefinition& definition, SerialisedMessage message);

/// Reads one number from serialised messages of one type. Reading does not allocate memory, and
/// never reads beyond the end of a message, whatever bytes it contains.
class MessageDecoder {
 public:
  /// `path` names a numeric field, such as "twist.twist.linear.x", "effort[0]" or, where the array
  /// `name` of the same message lists the names of the elements, "effort[wheel_left]": its place is
  /// looked up in each message, and a number as name stands in quotes. All builtin types
  /// but string are numeric; time and duration are read in seconds. The path "auto" means the only
  /// numeric field outside a std_msgs/Header. The path may begin with the last part of the topic's
  /// or the type's name if there is no field of that name: "joint_states.effort[0]" reads
  /// "effort[0]" on the topic /joint_states. Throws ConfigurationError when there is no such field;
  /// the message lists the numeric fields, the most similar names first.
  MessageDecoder(std::shared_ptr<const MessageDefinition> definition, const std::string& path,
                 const std::string& topic);

  /// The value of the field; 1 for true. Throws DataError when the message is shorter than its
  /// definition needs, has no array element of that index or name (the message of the error lists
  /// the names), or has more or fewer names than elements.
  double value(SerialisedMessage message) const;

  /// The names that this message gives to the elements of the array in the path, in their order;
  /// empty: it has none. Throws DataError as above.
  std::vector<std::string> elementNames(SerialisedMessage message) const;

  /// Whether messages have a stamp because they begin with a std_msgs/Header.
  bool hasStamp() const { return definition_->hasHeader(); }

  /// Stamp of the leading header [s]. Requires hasStamp(). Throws DataError as above.
  double stamp(SerialisedMessage message) const;

  /// Sequence number of the leading header. Requires hasStamp(). Throws DataError as above.
  std::uint32_t sequence(SerialisedMessage message) const;

  /// The resolved path, e.g. "effort[0]".
  const std::string& path() const { return path_.text; }

 private:
  std::shared_ptr<const MessageDefinition> definition_;
  FieldPath path_;
};

}  // namespace uncertainty_identification
