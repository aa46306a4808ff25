// What goes wrong on topics: publishers that come late, restart, change their type or send broken
// messages. The node reports it and records on.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <std_msgs/Float64.h>
#include <std_msgs/String.h>
#include <topic_tools/shape_shifter.h>

#include <cmath>

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
    return waitFor([&] { return client_.told().find(text) != std::string::npos; });
  }

  // Records an experiment and says how it is listed.
  messages::ExperimentSummary recordedNow() {
    const std::size_t before = listed().size();
    EXPECT_TRUE(signals_.record(experiment_));
    EXPECT_TRUE(waitFor([&] { return listed().size() > before; })) << client_.told();
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
  ASSERT_TRUE(waitFor([&] { return listed().size() == 1; })) << client_.told();
  EXPECT_NEAR(listed().front().samples, 60, 3);
}

TEST_F(TopicsTest, PublishersThatRestartLeaveAGap) {
  ASSERT_TRUE(signals_.trigger("start_experiment"));
  signals_.publish(experiment_, 0, 40);
  signals_.shutdown();
  signals_.advertise();
  signals_.publish(experiment_, 40, 100);
  ASSERT_TRUE(signals_.trigger("finish_experiment"));
  ASSERT_TRUE(waitFor([&] { return listed().size() == 1; })) << client_.told();
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
    EXPECT_TRUE(reported("std_msgs/String")) << client_.told();
  }
  {
    ros::Publisher unstamped = node_.advertise<std_msgs::Float64>("/sensor/measurement", 10);
    ASSERT_TRUE(waitFor([&] { return unstamped.getNumSubscribers() > 0; }));
    unstamped.publish(std_msgs::Float64());
    EXPECT_TRUE(reported("whose stamps come from another clock")) << client_.told();
  }
  signals_.advertise();
  expectThatTheNodeStillRecords();
  EXPECT_TRUE(waitFor([&] { return client_.told().find("std_msgs/String") == std::string::npos; }))
      << "the right type has returned";
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
        << client_.told();
    ASSERT_TRUE(signals_.trigger("reset"));
  }
  expectThatTheNodeStillRecords();
}

/// A publisher that numbers its messages itself.
ros::Publisher numberedByHand(ros::NodeHandle& node, const std::string& topic) {
  ros::AdvertiseOptions options;
  options.init<messages::Sample>(topic, 1000);
  options.has_header = false;  // else roscpp numbers them
  return node.advertise(options);
}

// The output's clock is 0.2 s ahead, its stamps are up to 1 ms off their grid, and three messages
// are missing.
TEST_F(TopicsTest, HowTheSamplesCameIsToldOfEachExperiment) {
  signals_.shutdown();
  ros::Publisher command = numberedByHand(node_, "/actuator/command");
  ros::Publisher measurement = numberedByHand(node_, "/sensor/measurement");
  ASSERT_TRUE(waitFor(
      [&] { return command.getNumSubscribers() > 0 && measurement.getNumSubscribers() > 0; }));
  ASSERT_TRUE(signals_.trigger("start_experiment"));
  const ros::Time begin = ros::Time::now();
  messages::Sample u, y;
  for (int k = 0; k < experiment_.samples(); ++k) {
    const ros::Time due = begin + ros::Duration(k * experiment_.sample_time);
    ros::Time::sleepUntil(due);
    ++u.header.seq;
    u.header.stamp = due;
    u.value = experiment_.u[k];
    command.publish(u);
    y.header.seq += k == 50 ? 4 : 1;
    y.header.stamp = due + ros::Duration(0.2 + (k % 3 - 1) * 0.001);
    y.value = experiment_.y[k];
    measurement.publish(y);
  }
  ASSERT_TRUE(signals_.trigger("finish_experiment"));
  ASSERT_TRUE(waitFor([&] { return listed().size() == 1; })) << client_.told();
  const auto summary = listed().front();
  EXPECT_EQ(summary.input.lost, 0U);
  EXPECT_EQ(summary.output.lost, 3U);
  EXPECT_NEAR(summary.clock_offset, 0.2, 0.05) << "the quickest of 100 transports each";
  EXPECT_LT(summary.input.jitter, 1e-5);
  EXPECT_NEAR(summary.output.jitter, 0.001, 1e-5);
  EXPECT_GE(summary.input.age, summary.input.delay);
  EXPECT_GT(summary.input.delay, 0);
}

/// Publishes the output of a simulation beside the measurement, which is `gain` times as large.
class SimulatedRig {
 public:
  explicit SimulatedRig(NodeClient& client) : client_(client) {
    waitFor([this] {
      return command_.getNumSubscribers() > 0 && measurement_.getNumSubscribers() > 0 &&
             simulation_.getNumSubscribers() > 0;
    });
  }

  /// One experiment of 100 samples; number `seed` of them.
  bool record(int seed, double gain) {
    if (!client_.call<std_srvs::Trigger>("start_experiment").success) return false;
    const ros::Time begin = ros::Time::now();
    messages::Sample sample;
    for (int k = 0; k < 100; ++k) {
      ros::Time::sleepUntil(begin + ros::Duration(0.01 * k));
      sample.header.stamp = ros::Time::now();
      const double simulated = 2 + std::sin(0.31 * k + seed) + 0.5 * std::sin(0.73 * k);
      publish(command_, simulated, sample);
      publish(measurement_, 0.3 + gain * simulated + 0.02 * std::sin(2.1 * k * (seed + 1)), sample);
      publish(simulation_, simulated, sample);
    }
    return client_.call<std_srvs::Trigger>("finish_experiment").success != 0;
  }

 private:
  static void publish(ros::Publisher& publisher, double value, messages::Sample& sample) {
    sample.value = value;
    publisher.publish(sample);
  }

  NodeClient& client_;
  ros::NodeHandle node_;
  ros::Publisher command_ = node_.advertise<messages::Sample>("/actuator/command", 1000);
  ros::Publisher measurement_ = node_.advertise<messages::Sample>("/sensor/measurement", 1000);
  ros::Publisher simulation_ = node_.advertise<messages::Sample>("/sim/measurement", 1000);
};

/// The part "simulation" of the newest diagnostics.
diagnostic_msgs::DiagnosticStatus simulationPart(
    const Latest<diagnostic_msgs::DiagnosticArray>& diagnostics) {
  for (const auto& status : diagnostics.get().status)
    if (status.name == "identification: simulation") return status;
  return {};
}

// The machine becomes twice as strong after six experiments: 0.3 + 1.2 y_sim, then 0.3 + 2.4 y_sim.
TEST_F(TopicsTest, ASimulationBesideTheSensorIsComparedAndItsDriftIsTold) {
  signals_.shutdown();
  const Latest<messages::SimulationError> told("/identification/simulation_error");
  const Latest<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  SimulatedRig rig(client_);
  for (int i = 0; i < 6; ++i) ASSERT_TRUE(rig.record(i, 1.2));
  ASSERT_TRUE(waitFor([&] { return told.get().drift_message.find("as far") != std::string::npos; }))
      << told.get();
  EXPECT_NEAR(told.get().gain.value, 1.2, 0.05);
  EXPECT_NEAR(told.get().bias.value, 0.3, 0.1);
  EXPECT_NEAR(told.get().delay.value, 0, 0.005);
  EXPECT_LT(told.get().gain.lower, told.get().gain.upper);
  EXPECT_FALSE(told.get().drifted);
  EXPECT_TRUE(waitFor([&] {
    const auto status = simulationPart(diagnostics);
    return !status.values.empty() && status.level == diagnostic_msgs::DiagnosticStatus::OK;
  })) << simulationPart(diagnostics);
  for (int i = 6; i < 9; ++i) ASSERT_TRUE(rig.record(i, 2.4));
  EXPECT_TRUE(waitFor([&] { return told.get().drifted; })) << told.get();
  EXPECT_TRUE(waitFor([&] {
    const auto status = simulationPart(diagnostics);
    return status.level == diagnostic_msgs::DiagnosticStatus::WARN &&
           status.message.find("has drifted away from the machine") != std::string::npos;
  })) << simulationPart(diagnostics);
}

}  // namespace
}  // namespace uncertainty_identification

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "topics_test");
  ros::NodeHandle node;
  return RUN_ALL_TESTS();
}
