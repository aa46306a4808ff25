#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>

#include <string>

#include "ros/signal_decoder.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {

/// Converts a serialised message to its compiled type. Throws ConfigurationError when the message
/// is of another type or of another version of the type, DataError when it is broken.
template <typename Message>
Message deserialise(const RawMessage& raw) {
  namespace traits = ros::message_traits;
  const std::string expected = traits::datatype<Message>();
  if (raw.type != expected || raw.md5sum != traits::md5sum<Message>()) {
    throw ConfigurationError("a message of type " + raw.type + " was found where " + expected +
                             " as this version defines it is expected");
  }
  // Checked first because roscpp allocates as many elements as an array's length says, even if the
  // message does not contain them.
  static const MessageDefinition kDefinition(expected, traits::definition<Message>());
  requireComplete(kDefinition, raw.bytes);
  ros::serialization::IStream stream(const_cast<std::uint8_t*>(raw.bytes.data),
                                     static_cast<std::uint32_t>(raw.bytes.size));
  Message message;
  try {
    ros::serialization::deserialize(stream, message);
  } catch (const std::exception& error) {
    throw DataError("a message of type " + raw.type + " is broken: " + error.what());
  }
  return message;
}

}  // namespace uncertainty_identification
