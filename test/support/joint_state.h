#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <std_msgs/Header.h>

#include <string>
#include <vector>

namespace uncertainty_identification::test {

/// A message with the fields of sensor_msgs/JointState, on which the package does not depend.
struct JointState {
  std_msgs::Header header;
  std::vector<std::string> name;
  std::vector<double> position, velocity, effort;
};

}  // namespace uncertainty_identification::test

namespace ros {
namespace message_traits {

using uncertainty_identification::test::JointState;

template <>
struct HasHeader<JointState> : TrueType {};

template <>
struct DataType<JointState> {
  static const char* value() { return "sensor_msgs/JointState"; }
  static const char* value(const JointState&) { return value(); }
};

template <>
struct MD5Sum<JointState> {
  static const char* value() { return "3066dcd76a6cfaef579bd0f34173e9fd"; }
  static const char* value(const JointState&) { return value(); }
};

template <>
struct Definition<JointState> {
  static const char* value() {
    return "Header header\n\nstring[] name\nfloat64[] position\nfloat64[] velocity\n"
           "float64[] effort\n"
           "================================================================================\n"
           "MSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n";
  }
  static const char* value(const JointState&) { return value(); }
};

}  // namespace message_traits

namespace serialization {

template <>
struct Serializer<message_traits::JointState> {
  template <typename Stream, typename Message>
  static void allInOne(Stream& stream, Message message) {
    stream.next(message.header);
    stream.next(message.name);
    stream.next(message.position);
    stream.next(message.velocity);
    stream.next(message.effort);
  }
  ROS_DECLARE_ALLINONE_SERIALIZER
};

}  // namespace serialization
}  // namespace ros
