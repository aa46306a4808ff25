#pragma once

#include <map>
#include <memory>
#include <string>

#include "ros/message_decoder.h"
#include "uncertainty_identification/data/signal_timing.h"

namespace uncertainty_identification {

/// A message with what bags and connections tell about it. The texts outlive the call they are
/// passed to.
struct RawMessage {
  const std::string& type;        ///< package/Type
  const std::string& md5sum;      ///< of the type; the key under which decoders are kept
  const std::string& definition;  ///< text of the type and of those it contains
  SerialisedMessage bytes;
  double receipt = 0;          ///< [s] when it was received or recorded
  std::string publisher = {};  ///< whose header counts its messages; empty: not known
};

/// One message of a signal.
struct StampedValue {
  double stamp = 0;  ///< [s] of the header where there is one, else receipt
  double value = 0;
  Arrival arrival = {};  ///< of a message with a header; else nothing is known
};

/// Throws DataError when the message has to be stamped on receipt, but the clock had not started.
void requireReceipt(const RawMessage& message);

/// Reads one numeric field out of the messages of a topic, whatever their type.
class SignalDecoder {
 public:
  /// `field` as MessageDecoder takes it.
  SignalDecoder(std::string topic, std::string field);

  /// Throws ConfigurationError when the type has no such field, and DataError when the message is
  /// broken, its definition cannot be read, or its type has a header where that of the messages
  /// before had none, or the reverse: two clocks are never mixed within one signal. A type that was
  /// refused once is refused again without further work.
  StampedValue decode(const RawMessage& message);

  const std::string& topic() const { return topic_; }

  /// Whether stamps are times of receipt because the messages have no header; false before the
  /// first message.
  bool stampedOnReceipt() const { return clock_ == Clock::receipt; }

 private:
  enum class Clock { unknown, header, receipt };

  const MessageDecoder& decoderFor(const RawMessage& message);

  std::string topic_, field_;
  std::map<std::string, std::unique_ptr<const MessageDecoder>> decoders_;  // by md5sum
  std::map<std::string, std::string> refused_;                             // md5sum to reason
  Clock clock_ = Clock::unknown;
  SequenceCounter sequences_;
};

}  // namespace uncertainty_identification
