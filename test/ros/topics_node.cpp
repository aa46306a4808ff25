// What goes wrong on topics: publishers that come late, restart, change their type or send broken
// messages. The node reports it and records on.

#include <gtest/gtest.h>
#include <std_msgs/Float64.h>
#include <std_msgs/String.h>
#include <topic_tools/shape_shifter.h>

#include "support/example1.h"
#include "support/node_client.h"
#include "support/signal_publisher.h"

namespace uncertainty_identification {
namespace {

class TopicsTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(client_.waitForNode());
    ASSERT_TRUE(signals_.trigger("reset"));
  }

  std::vector<messages::ExperimentSummary> listed() {
    return client_.call<messages::ListExperiments>("list_experiments").experiments;
  }

  bool reported(const std::string& text) {
    return waitFor([&] { return client_.status().message.find(text) != std::string::npos; });
  }

  // Records an experiment and says how it is listed.
  messages::ExperimentSummary recordedNow() {
    const std::size_t before = listed().size();
    EXPECT_TRUE(signals_.record(experiment_));
    EXPECT_TRUE(waitFor([&] { return listed().size() > before; })) << client_.status().message;
    return listed().back();
  }

  void expectThatTheNodeStillRecords() {
    const auto summary = recordedNow();
    EXPECT_EQ(summary.rejected, "");
    EXPECT_NEAR(summary.samples, 100, 3);  // published when due, by a clock that others use too
  }

  NodeClient client_;
  SignalPublisher signals_{client_};
  ros::NodeHandle node_;
  const Experiment experiment_ = example1Experiments(1).front();
};

TEST_F(TopicsTest, PublishersThatComeLateAreRecordedFromThenOn) {
  signals_.shutdown();
  ASSERT_TRUE(signals_.trigger("start_experiment"));
  signals_.advertise();
  signals_.publish(experiment_, 0, 60);
  ASSERT_TRUE(signals_.trigger("finish_experiment"));
  ASSERT_TRUE(waitFor([&] { return listed().size() == 1; })) << client_.status().message;
  EXPECT_NEAR(listed().front().samples, 60, 3);
}

TEST_F(TopicsTest, PublishersThatRestartLeaveAGap) {
  ASSERT_TRUE(signals_.trigger("start_experiment"));
  signals_.publish(experiment_, 0, 40);
  signals_.shutdown();
  signals_.advertise();
  signals_.publish(experiment_, 40, 100);
  ASSERT_TRUE(signals_.trigger("finish_experiment"));
  ASSERT_TRUE(waitFor([&] { return listed().size() == 1; })) << client_.status().message;
  EXPECT_GE(listed().front().samples, 95U);
  expectThatTheNodeStillRecords();
}

TEST_F(TopicsTest, ATopicOfAnotherTypeIsReportedAndLeftOut) {
  expectThatTheNodeStillRecords();
  signals_.shutdown();
  {
    ros::Publisher text = node_.advertise<std_msgs::String>("/sensor/measurement", 10);
    ASSERT_TRUE(waitFor([&] { return text.getNumSubscribers() > 0; }));
    text.publish(std_msgs::String());
    EXPECT_TRUE(reported("std_msgs/String")) << client_.status().message;
  }
  {
    ros::Publisher unstamped = node_.advertise<std_msgs::Float64>("/sensor/measurement", 10);
    ASSERT_TRUE(waitFor([&] { return unstamped.getNumSubscribers() > 0; }));
    unstamped.publish(std_msgs::Float64());
    EXPECT_TRUE(reported("whose stamps come from another clock")) << client_.status().message;
  }
  signals_.advertise();
  expectThatTheNodeStillRecords();
}

TEST_F(TopicsTest, MessagesOfTheWrongSizeAreLeftOut) {
  namespace traits = ros::message_traits;
  messages::Sample sample;
  sample.header.frame_id = "rig";
  sample.value = 1;
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(sample));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, sample);
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{3}, std::size_t{14}, bytes.size() - 1}) {
    topic_tools::ShapeShifter cut;
    cut.morph(traits::md5sum(sample), traits::datatype(sample), traits::definition(sample), "");
    std::vector<std::uint8_t> part(bytes.begin(), bytes.begin() + static_cast<long>(size));
    part.push_back(0);  // so that there is an address
    ros::serialization::IStream cut_stream(part.data(), static_cast<std::uint32_t>(size));
    cut.read(cut_stream);
    ros::Publisher publisher = cut.advertise(node_, "/covariate/temperature", 10);
    ASSERT_TRUE(waitFor([&] { return publisher.getNumSubscribers() > 0; }));
    publisher.publish(cut);
    EXPECT_TRUE(
        reported("covariate 'temperature': a message of topic '/covariate/temperature' was "
                 "left out because"))
        << client_.status().message;
    ASSERT_TRUE(signals_.trigger("reset"));
  }
  expectThatTheNodeStillRecords();
}

}  // namespace
}  // namespace uncertainty_identification

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "topics_test");
  ros::NodeHandle node;
  return RUN_ALL_TESTS();
}
