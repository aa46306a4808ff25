#include "ros/signal_decoder.h"

#include <limits>
#include <utility>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

void requireReceipt(const RawMessage& message) {
  if (message.receipt > 0) return;
  throw DataError("type " + message.type +
                  " has no header, and the clock that stamps it on receipt has not started; with "
                  "use_sim_time something must publish /clock");
}

SignalDecoder::SignalDecoder(std::string topic, std::string field)
    : topic_(std::move(topic)), field_(std::move(field)) {}

StampedValue SignalDecoder::decode(const RawMessage& message) {
  const MessageDecoder& decoder = decoderFor(message);
  const Clock clock = decoder.hasStamp() ? Clock::header : Clock::receipt;
  if (clock_ != Clock::unknown && clock != clock_) {
    throw DataError("topic '" + topic_ + "' changed to type " + message.type +
                    ", whose stamps come from another clock; use one type per topic");
  }
  if (clock == Clock::receipt) requireReceipt(message);
  StampedValue sample{message.receipt, decoder.value(message.bytes)};
  if (clock == Clock::header) {
    sample.stamp = decoder.stamp(message.bytes);
    sample.arrival = {message.receipt > 0 ? message.receipt : kNotKnown,
                      sequences_.missingBefore(message.publisher, decoder.sequence(message.bytes))};
  }
  clock_ = clock;
  return sample;
}

const MessageDecoder& SignalDecoder::decoderFor(const RawMessage& message) {
  const auto known = decoders_.find(message.md5sum);
  if (known != decoders_.end()) return *known->second;
  const auto refused = refused_.find(message.md5sum);
  if (refused != refused_.end()) throw ConfigurationError(refused->second);
  try {
    auto definition = std::make_shared<MessageDefinition>(message.type, message.definition);
    auto decoder = std::make_unique<MessageDecoder>(std::move(definition), field_, topic_);
    return *(decoders_[message.md5sum] = std::move(decoder));
  } catch (const ConfigurationError& error) {
    refused_[message.md5sum] = error.what();
    throw;
  }
}

}  // namespace uncertainty_identification
