#pragma once

#include <map>
#include <memory>
#include <string>

#include "ros/message_decoder.h"
#include "uncertainty_identification/data/signal_timing.h"

namespace uncertainty_identification {

/// A serialised message, and what a bag or a connection states about it. It only refers to texts
/// and bytes, so it must not be kept.
struct RawMessage {
  const std::string& type;        ///< package/Type
  const std::string& md5sum;      ///< of the type; identifies its version
  const std::string& definition;  ///< definition of the type and of those it contains
  SerialisedMessage bytes;
  double receipt = 0;          ///< [s] time at which it was received or recorded
  std::string publisher = {};  ///< name of the publishing node; empty if not known
};

/// One message of a signal.
struct StampedValue {
  double stamp = 0;  ///< [s] of the header if there is one, otherwise time of receipt
  double value = 0;
  Arrival arrival = {};  ///< known only for messages with a header
};

/// For messages without a header: throws DataError when the clock had not started on receipt.
void requireReceipt(const RawMessage& message);

/// Reads one numeric field from the messages of a topic, whatever their type.
class SignalDecoder {
 public:
  /// `field` is a path as described at MessageDecoder.
  SignalDecoder(std::string topic, std::string field);

  /// Throws ConfigurationError when the type has no such field; this is remembered for each type.
  /// Throws DataError when the message is broken, when its definition cannot be read, and when it
  /// has a header but earlier messages had none, or the reverse: the clocks of headers and of
  /// receipt are never mixed within one signal.
  StampedValue decode(const RawMessage& message);

  const std::string& topic() const { return topic_; }

  /// Whether stamps are times of receipt because the messages have no header. False before the
  /// first message.
  bool stampedOnReceipt() const { return clock_ == Clock::receipt; }

 private:
  enum class Clock { unknown, header, receipt };

  const MessageDecoder& decoderFor(const RawMessage& message);

  std::string topic_, field_;
  std::map<std::string, std::unique_ptr<const MessageDecoder>> decoders_;  // the key is the md5sum
  std::map<std::string, std::string> refused_;  // the key is the md5sum, the value the reason
  Clock clock_ = Clock::unknown;
  SequenceCounter sequences_;
};

}  // namespace uncertainty_identification
