#include "ros/topic_router.h"

#include <gtest/gtest.h>
#include <ros/serialization.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Float64.h>
#include <std_msgs/String.h>

#include <cmath>

#include "ros/messages.h"
#include "support/error_message.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

/// A router that is fed with messages as a connection delivers them.
class TopicRouterTest : public testing::Test {
 protected:
  template <typename Message>
  void add(const std::string& topic, const Message& message, double receipt) {
    const std::string type = ros::message_traits::datatype<Message>();
    const std::string md5sum = ros::message_traits::md5sum<Message>();
    const std::string definition = ros::message_traits::definition<Message>();
    std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
    ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
    ros::serialization::serialize(stream, message);
    if (truncate_ && bytes.size() > 1) bytes.pop_back();
    router_.add(topic, {type, md5sum, definition, {bytes.data(), bytes.size()}, receipt});
  }

  static messages::Sample sample(double stamp, double value) {
    messages::Sample sample;
    sample.header.stamp.fromSec(stamp);
    sample.value = value;
    return sample;
  }

  static std_msgs::Float64 number(double value) {
    std_msgs::Float64 number;
    number.data = value;
    return number;
  }

  void mark(double stamp, bool active) {
    messages::ExperimentMarker marker;
    marker.header.stamp.fromSec(stamp);
    marker.id = "run";
    marker.active = active;
    add("/experiment/active", marker, 1000);
  }

  std::vector<Recording> finished() {
    router_.cutter().flush();
    return router_.cutter().takeFinished();
  }

  bool truncate_ = false;
  TopicRouter router_{Configuration(), [](const std::string& topic) { return "/" + topic; }};
};

TEST_F(TopicRouterTest, StampsComeFromHeadersWhereThereAreAny) {
  mark(10, true);
  for (int k = 0; k < 5; ++k) {
    add("/actuator/command", sample(10 + k, k), 500);
    add("/sensor/measurement", number(2 * k), 10 + k);
  }
  mark(15, false);
  const auto recordings = finished();
  ASSERT_EQ(recordings.size(), 1U);
  EXPECT_EQ(recordings[0].id, "run");
  EXPECT_EQ(recordings[0].input.stamps, (std::vector<double>{10, 11, 12, 13, 14}));
  EXPECT_EQ(recordings[0].output.stamps, (std::vector<double>{10, 11, 12, 13, 14}));
  EXPECT_EQ(recordings[0].output.values, (std::vector<double>{0, 2, 4, 6, 8}));
  EXPECT_EQ(router_.stampedOnReceipt(), std::vector<std::string>{"/sensor/measurement"});
  EXPECT_TRUE(router_.warnings().empty());
}

TEST_F(TopicRouterTest, ArrivalsAndLossesOfMessagesWithHeadersAreKept) {
  mark(10, true);
  for (std::uint32_t k = 0; k < 5; ++k) {
    auto command = sample(10 + k, k);
    command.header.seq = k < 3 ? k : k + 2;  // two are missing before the fourth
    add("/actuator/command", command, 10.5 + k);
    add("/sensor/measurement", number(2 * k), 10 + k);
  }
  mark(15, false);
  const auto recordings = finished();
  ASSERT_EQ(recordings.size(), 1U);
  EXPECT_EQ(recordings[0].input.arrivals, (std::vector<double>{10.5, 11.5, 12.5, 13.5, 14.5}));
  EXPECT_EQ(recordings[0].input.lost, 2);
  for (const double arrival : recordings[0].output.arrivals) EXPECT_TRUE(std::isnan(arrival));
  EXPECT_EQ(recordings[0].output.lost, 0);
}

TEST_F(TopicRouterTest, SamplesThatAreNotFiniteAreCountedAndToldOnce) {
  for (const double value : {1.0, std::nan(""), HUGE_VAL, 2.0, -HUGE_VAL})
    add("/sensor/measurement", number(value), 10);
  const auto problems = router_.takeProblems();
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_NE(problems[0].find("output: a sample of topic '/sensor/measurement' is nan"),
            std::string::npos)
      << problems[0];
  for (const auto& use : router_.uses()) EXPECT_EQ(use.not_finite, use.key == "output" ? 3 : 0);
  const auto warnings = router_.warnings();
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("output: 3 of 5 samples of topic '/sensor/measurement' are NaN"),
            std::string::npos)
      << warnings[0];
}

TEST_F(TopicRouterTest, AMarkerWhoseNameIsNoTextIsEscaped) {
  messages::ExperimentMarker marker;
  marker.header.stamp = ros::Time(10);
  marker.id = "run \xFF";
  marker.active = 1;
  add("/experiment/active", marker, 10);
  add("/sensor/measurement", number(1), 11);
  add("/actuator/command", sample(11, 1), 11);
  marker.header.stamp = ros::Time(12);
  marker.active = 0;
  add("/experiment/active", marker, 12);
  const auto recordings = finished();
  ASSERT_EQ(recordings.size(), 1U);
  EXPECT_EQ(recordings[0].id, "run \\xFF");
}

TEST_F(TopicRouterTest, ClocksAreNotMixedWithinASignal) {
  add("/actuator/command", sample(10, 1), 500);
  add("/actuator/command", number(2), 11);
  add("/actuator/command", number(3), 12);
  const auto problems = router_.takeProblems();
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_NE(problems[0].find("changed to type std_msgs/Float64"), std::string::npos) << problems[0];
  EXPECT_TRUE(router_.takeProblems().empty());
  ASSERT_EQ(router_.warnings().size(), 1U);
  EXPECT_NE(router_.warnings()[0].find("2 messages of topic '/actuator/command'"),
            std::string::npos)
      << router_.warnings()[0];
}

TEST_F(TopicRouterTest, AnotherTypeOfTheSameClockIsDecodedAnew) {
  add("/sensor/measurement", number(1), 10);
  std_msgs::Bool flag;
  flag.data = 1;
  add("/sensor/measurement", flag, 11);
  EXPECT_TRUE(router_.takeProblems().empty());
}

TEST_F(TopicRouterTest, TypesWithoutTheFieldAreRefusedEachTime) {
  for (int i = 0; i < 3; ++i)
    EXPECT_NE(messageOf<ConfigurationError>([&] {
                add("/sensor/measurement", std_msgs::String(), 10 + i);
              }).find("it has no numeric field"),
              std::string::npos);
  add("/sensor/measurement", number(1), 20);
  EXPECT_EQ(router_.stampedOnReceipt().size(), 1U);
}

TEST_F(TopicRouterTest, MessagesBeforeTheClockStartsAreLeftOut) {
  add("/sensor/measurement", number(1), 0);
  std_msgs::Bool active;
  active.data = 1;
  add("/experiment/active", active, 0);
  const auto problems = router_.takeProblems();
  ASSERT_EQ(problems.size(), 2U);
  for (const auto& problem : problems)
    EXPECT_NE(problem.find("publish /clock"), std::string::npos) << problem;
  EXPECT_FALSE(router_.cutter().running());
}

TEST_F(TopicRouterTest, BrokenMessagesAreCounted) {
  truncate_ = true;
  add("/actuator/command", sample(10, 1), 10);
  mark(10, true);
  EXPECT_EQ(router_.takeProblems().size(), 2U);
  EXPECT_EQ(router_.warnings().size(), 2U);
}

TEST_F(TopicRouterTest, OtherTopicsAreIgnored) {
  add("/elsewhere", number(1), 10);
  EXPECT_TRUE(router_.takeProblems().empty());
  EXPECT_TRUE(finished().empty());
}

}  // namespace
}  // namespace uncertainty_identification
