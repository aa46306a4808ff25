// Elements of arrays that are called by the names which each message lists, as in a JointState.
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <std_msgs/Float64MultiArray.h>

#include <random>

#include "io/inspection_yaml.h"
#include "ros/bag_survey.h"
#include "ros/message_decoder.h"
#include "ros/survey_data.h"
#include "support/error_message.h"
#include "support/joint_state.h"
#include "support/mentions.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/ros/load_data.h"

namespace uncertainty_identification {
namespace {

using test::JointState;
using test::mentions;

JointState robotState() {
  JointState state;
  state.name = {"arm", "wheel_left", "base/wheel.right", "7"};
  state.position = {1, 2, 3, 4};
  state.effort = {10, 20, 30, 40};
  return state;
}

template <typename Message>
double decoded(const Message& message, const std::string& path) {
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  const auto definition = std::make_shared<MessageDefinition>(
      ros::message_traits::datatype<Message>(), ros::message_traits::definition<Message>());
  return MessageDecoder(definition, path, "/joint_states").value({bytes.data(), bytes.size()});
}

TEST(JointNames, AreLookedUpInTheMessage) {
  EXPECT_EQ(decoded(robotState(), "effort[wheel_left]"), 20);
  EXPECT_EQ(decoded(robotState(), "joint_states.effort[wheel_left]"), 20);
  EXPECT_EQ(decoded(robotState(), "joint_state.position[base/wheel.right]"), 3);
  EXPECT_EQ(decoded(robotState(), "effort['7']"), 40) << "a name that is a number";
  EXPECT_EQ(decoded(robotState(), "effort[\"arm\"]"), 10);
  EXPECT_EQ(decoded(robotState(), "effort[3]"), 40);
  JointState other = robotState();
  std::swap(other.name[0], other.name[1]);
  EXPECT_EQ(decoded(other, "effort[wheel_left]"), 10) << "another order in another message";
}

TEST(JointNames, ThatAMessageLacksAreRefusedWithThoseItHas) {
  const std::string absent = messageOf<DataError>([] { decoded(robotState(), "effort[wheel]"); });
  EXPECT_TRUE(mentions(absent,
                       "'effort[wheel]': the message names no 'wheel'; its names are "
                       "'arm', 'wheel_left', 'base/wheel.right', '7'"))
      << absent;
  const std::string number = messageOf<DataError>([] { decoded(robotState(), "effort['9']"); });
  EXPECT_TRUE(mentions(number, "'effort['9']': the message names no '9'")) << number;
  const std::string shorter = messageOf<DataError>([] { decoded(robotState(), "velocity[arm]"); });
  EXPECT_TRUE(mentions(shorter, "the message has 4 names for 0 elements")) << shorter;
  EXPECT_TRUE(mentions(messageOf<DataError>([] { decoded(JointState(), "effort[arm]"); }),
                       "its list 'name' is empty"));
}

TEST(JointNames, NeedAListOfNamesInTheType) {
  const std::string message = messageOf<ConfigurationError>(
      [] { decoded(std_msgs::Float64MultiArray(), "data[wheel_left]"); });
  EXPECT_TRUE(mentions(message, "has no numeric field 'data[wheel_left]'")) << message;
  EXPECT_TRUE(mentions(message, "only where the message has an array 'name'")) << message;
  for (const char* path : {"effort[", "effort[]", "effort[arm", "effort[arm]x", "effort[0]y",
                           "[arm]", "effort[1234567890]"})
    EXPECT_TRUE(mentions(messageOf<ConfigurationError>([&] { decoded(robotState(), path); }), path))
        << path;
}

class JointBag : public testing::Test {
 protected:
  /// Effort and speed of two wheels, whose order changes; every tenth message is of an arm.
  JointBag() {
    rosbag::Bag bag(path_, rosbag::bagmode::Write);
    std::mt19937 random(4);
    double torque = 1, speed = 0;
    for (int k = 0; k < 1000; ++k) {
      if (k % 8 == 0) torque = random() % 2 == 0 ? 1 : -1;
      JointState state;
      state.header.stamp = ros::Time(10 + 0.02 * k);
      const bool swapped = k % 3 == 1;
      state.name = {swapped ? "right" : "left", swapped ? "left" : "right"};
      state.position = {0, 0};
      state.effort = {swapped ? 0 : torque, swapped ? torque : 0};
      state.velocity = {swapped ? 0 : speed, swapped ? speed : 0};
      bag.write("/joint_states", state.header.stamp, state);
      speed = 0.8 * speed + 0.5 * torque + 1e-3 * (random() % 100);
      if (k % 10 != 5) continue;
      state.name = {"elbow"};
      state.position = state.velocity = state.effort = {100};
      state.header.stamp += ros::Duration(0.005);
      bag.write("/joint_states", state.header.stamp, state);
    }
  }

  const TemporaryFolder folder_;
  const std::string path_ = folder_ / "robot.bag";
};

TEST_F(JointBag, IsReadByName) {
  Configuration configuration;
  configuration.input = {"", "joint_states", "effort[left]"};
  configuration.output = {"", "joint_states", "joint_states.velocity[left]"};
  configuration.experiment.mode = ExperimentMode::duration;
  configuration.experiment.duration = 100;
  const LoadedData data = readBag(path_, configuration);
  ASSERT_EQ(data.experiments.size(), 1u);
  EXPECT_EQ(data.experiments[0].u.array().abs().minCoeff(), 1) << "never that of the other wheel";
  EXPECT_TRUE(test::anyMentions(data.warnings,
                                "input: 100 messages of topic '/joint_states' were left out; the "
                                "first because field 'effort[left]': the message names no 'left'; "
                                "its names are 'elbow'"));
}

TEST_F(JointBag, IsSuggestedByName) {
  const InspectedData data = inspectData({path_}, {}, false);
  ASSERT_TRUE(data.choice.chosen) << data.choice.doubt;
  EXPECT_EQ(data.configuration.input.field, "effort[left]");
  EXPECT_EQ(data.configuration.output.field, "velocity[left]");
  EXPECT_TRUE(mentions(inspectionYaml(data), "field: \"effort[left]\"}"));
}

TEST_F(JointBag, IsStillFoundByNumber) {
  Configuration stated;
  stated.input = {"", "joint_states", "effort[1]"};
  stated.output = {"", "joint_states", "velocity[1]"};
  const InspectedData data = inspectData({path_}, stated, true);
  ASSERT_TRUE(data.choice.chosen);
  EXPECT_EQ(data.survey.channels[data.choice.chosen->input].field, "effort[right]");
  EXPECT_EQ(data.configuration.input.field, "effort[1]");
}

}  // namespace
}  // namespace uncertainty_identification
