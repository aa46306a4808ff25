#pragma once

#include <ros/serialization.h>

#include <cstdint>

// Included by messages.h alone, which declares the goals.
namespace ros::serialization {

/// roscpp makes room for as many strings as a message says it holds before it looks whether it is
/// that long; goals arrive on a topic that anybody may publish on. For goals that are names of bags
/// and a configuration; throws StreamOverrunException.
template <typename Goal>
struct GoalSerializer {
  static void read(IStream& stream, Goal& goal) {
    constexpr std::uint32_t kLargest = 1U << 20;  // [bytes]
    IStream ahead = stream;
    std::uint32_t count = 0;
    ahead.next(count);
    if (stream.getLength() > kLargest || count > ahead.getLength() / sizeof count)
      throwStreamOverrun();
    stream.next(goal.bags);
    stream.next(goal.configuration);
  }

  template <typename Stream>
  static void write(Stream& stream, const Goal& goal) {
    stream.next(goal.bags);
    stream.next(goal.configuration);
  }

  static std::uint32_t serializedLength(const Goal& goal) {
    return serializationLength(goal.bags) + serializationLength(goal.configuration);
  }
};

template <>
struct Serializer<uncertainty_identification_messages::IdentifyBagsGoal>
    : GoalSerializer<uncertainty_identification_messages::IdentifyBagsGoal> {};

template <>
struct Serializer<uncertainty_identification_messages::ExplainExperimentsGoal>
    : GoalSerializer<uncertainty_identification_messages::ExplainExperimentsGoal> {};

}  // namespace ros::serialization
