#pragma once

#include <ros/serialization.h>

#include <cstdint>

// To be included only by messages.h, which declares the goals.
namespace ros::serialization {

/// Reads goals that consist of names of bags and a configuration, and checks the sizes first.
/// roscpp itself allocates as many strings as a message claims to hold, and anybody can publish on
/// the topic of the goals. Throws StreamOverrunException.
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
