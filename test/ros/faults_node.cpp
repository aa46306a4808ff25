// The node with a result, fault-free samples and then faulty ones (Example 1, simulated).

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <std_msgs/Bool.h>

#include <mutex>
#include <vector>

#include "io/read_file.h"
#include "ros/message_conversions.h"
#include "support/faults.h"
#include "support/monte_carlo.h"
#include "support/temporary_folder.h"
#include "support/wait_for.h"

namespace uncertainty_identification {
namespace {

using test::Fault;
using test::FaultKind;
using test::FaultyPlant;

constexpr int kWindow = 40;    // as in faults.test
constexpr int kOnset = 400;    // [sample]
constexpr int kSamples = 800;  // of the experiment; the signals go on
constexpr int kPublished = 820;

class FaultDetectionTest : public testing::Test {
 protected:
  FaultDetectionTest() : spinner_(1) {
    status_ = node_.subscribe<messages::FaultStatus>(
        "/fault_detection/status", 1000, [this](const messages::FaultStatus::ConstPtr& status) {
          const std::lock_guard<std::mutex> lock(mutex_);
          windows_.push_back(*status);
        });
    diagnostics_ = node_.subscribe<diagnostic_msgs::DiagnosticArray>(
        "/diagnostics", 100, [this](const diagnostic_msgs::DiagnosticArray::ConstPtr& array) {
          const std::lock_guard<std::mutex> lock(mutex_);
          ++diagnoses_;
          for (const auto& status : array->status) {
            level_ = status.level;
            for (const auto& value : status.values) {
              if (value.key == "markers") markers_ = std::stoi(value.value);
              if (value.key == "result sequence") sequence_ = std::stoul(value.value);
            }
          }
        });
    spinner_.start();
  }

  void SetUp() override {
    ASSERT_TRUE(waitFor([this] {
      return result_.getNumSubscribers() > 0 && marker_.getNumSubscribers() > 0 &&
             status_.getNumPublishers() > 0;
    }));
  }

  void publishResult(std::uint32_t sequence) {
    ResultContext context;
    context.stamp = ros::Time::now().toNSec();
    context.sequence = sequence;
    result_.publish(toMessage(test::estimateOf(test::example1Truth()), context));
    // Topics are not ordered among each other.
    ASSERT_TRUE(waitFor([&] { return adopted() == sequence; })) << adopted();
  }

  // Stamps count, not arrival: the experiment is there at once.
  void publish(const Experiment& experiment, double begin) {
    ASSERT_TRUE(waitFor([this] {
      return command_.getNumSubscribers() > 0 && measurement_.getNumSubscribers() > 0;
    }));
    messages::ExperimentMarker marker;
    marker.header.stamp = ros::Time(begin);
    marker.active = true;
    marker_.publish(marker);
    published_markers_ += 2;
    marker.header.stamp = ros::Time(begin + kSamples * experiment.sample_time);
    marker.active = false;
    marker_.publish(marker);
    ASSERT_TRUE(waitFor([&] { return markers() == published_markers_; })) << markers();
    messages::Sample sample;
    for (int k = 0; k < experiment.samples(); ++k) {
      sample.header.stamp = ros::Time(begin + k * experiment.sample_time);
      sample.value = experiment.u[k];
      command_.publish(sample);
      sample.value = experiment.y[k];
      measurement_.publish(sample);
    }
  }

  std::vector<messages::FaultStatus> windows() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return windows_;
  }

  int markers() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return markers_;
  }

  unsigned long adopted() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return sequence_;
  }

  int diagnoses() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return diagnoses_;
  }

  int level() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return level_;
  }

  ros::NodeHandle node_;
  ros::Publisher result_ =
      node_.advertise<messages::IdentificationResult>("/identification/result", 1, true);
  ros::Publisher marker_ = node_.advertise<messages::ExperimentMarker>("/experiment/active", 10);
  ros::Publisher command_ = node_.advertise<messages::Sample>("/actuator/command", 2000);
  ros::Publisher measurement_ = node_.advertise<messages::Sample>("/sensor/measurement", 2000);
  std::mutex mutex_;
  std::vector<messages::FaultStatus> windows_;
  int level_ = -1, markers_ = 0, diagnoses_ = 0;
  unsigned long sequence_ = 0;    // of the result in use
  static int published_markers_;  // by all tests: the node counts on
  ros::Subscriber status_, diagnostics_;
  ros::AsyncSpinner spinner_;
};

int FaultDetectionTest::published_markers_ = 0;

TEST_F(FaultDetectionTest, RaisesTheFlagWhenAFaultBegins) {
  const FaultyPlant plant(test::example1Truth(1, kPublished), 11);
  publishResult(5);
  const double begin = 1000;
  publish(plant.experiment(0, {FaultKind::effectiveness, 0.3, kOnset}), begin);
  const std::size_t expected = kSamples / kWindow;
  ASSERT_TRUE(waitFor([&] { return windows().size() >= expected; })) << windows().size();
  const auto found = windows();
  ASSERT_EQ(found.size(), expected);
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_EQ(found[k].fault != 0, k >= kOnset / kWindow) << "window " << k;
    EXPECT_EQ(found[k].fault != 0, found[k].statistic > found[k].threshold);
    EXPECT_EQ(found[k].sequence, 5u);
    EXPECT_NEAR(found[k].window_start.toSec(), begin + static_cast<double>(k) * 0.4, 1e-6);
    EXPECT_NEAR(found[k].header.stamp.toSec(), begin + static_cast<double>(k) * 0.4 + 0.39, 1e-6);
    EXPECT_EQ(found[k].window_measured, static_cast<std::uint32_t>(kWindow));
    ASSERT_EQ(found[k].component_probabilities.size(), 2u);
    EXPECT_NEAR(found[k].component_probabilities[0] + found[k].component_probabilities[1], 1, 1e-9);
    EXPECT_EQ(found[k].error_mean.size(), 1u);
    EXPECT_EQ(found[k].tests.size(), found[k].test_probabilities.size());
  }
  const auto flag = ros::topic::waitForMessage<std_msgs::Bool>("/fault_detection/fault", node_,
                                                               ros::Duration(60));
  ASSERT_TRUE(flag) << "the flag is latched";
  EXPECT_TRUE(flag->data);
  EXPECT_TRUE(waitFor([this] { return level() == diagnostic_msgs::DiagnosticStatus::ERROR; }));
}

TEST_F(FaultDetectionTest, ANewResultAndANewExperimentBeginWithoutTheFault) {
  publishResult(6);
  publish(FaultyPlant(test::example1Truth(1, kPublished), 11).experiment(1, {}), 2000);
  ASSERT_TRUE(waitFor([this] { return windows().size() >= kSamples / kWindow; }))
      << windows().size();
  for (const auto& window : windows()) {
    EXPECT_EQ(window.sequence, 6u);
    EXPECT_FALSE(window.fault) << window.statistic;
  }
  EXPECT_TRUE(waitFor([this] { return level() == diagnostic_msgs::DiagnosticStatus::OK; }));
  const auto flag = ros::topic::waitForMessage<std_msgs::Bool>("/fault_detection/fault", node_,
                                                               ros::Duration(60));
  ASSERT_TRUE(flag);
  EXPECT_FALSE(flag->data);
}

TEST_F(FaultDetectionTest, AResultThatCannotBeReadIsToldAndTheOldOneStays) {
  messages::IdentificationResult broken;
  broken.result_json = "{\"format\":";
  result_.publish(broken);
  publish(FaultyPlant(test::example1Truth(1, kPublished), 11).experiment(1, {}), 3000);
  ASSERT_TRUE(waitFor([this] { return windows().size() >= kSamples / kWindow; }));
  EXPECT_EQ(windows().back().sequence, 6u);
  EXPECT_TRUE(waitFor([this] { return level() == diagnostic_msgs::DiagnosticStatus::WARN; }));
}

TEST_F(FaultDetectionTest, DiagnosticsComeWhileTheClockStandsStill) {
  ASSERT_EQ(ros::Time::now(), ros::Time(0)) << "nobody publishes /clock";
  const int before = diagnoses();
  EXPECT_TRUE(waitFor([&] { return diagnoses() >= before + 3; }));
}

TEST(FaultDetectionParameters, BadOnesEndTheNodeWithAMessage) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"_window:=3", "window: found 3"},
      {"_fals_alarm_rate:=0.1", "did you mean false_alarm_rate?"},
      {"_input/topic:=bad~name", "bad~name"}};
  for (const auto& [parameters, message] : cases) {
    const TemporaryFolder folder;
    const std::string log = folder / "log";
    const int status =
        std::system((std::string(TOOLS_FOLDER) + "/fault_detection_node __name:=broken " +
                     parameters + " > " + log + " 2>&1")
                        .c_str());
    ros::param::del("/broken");
    EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, 2) << parameters;
    EXPECT_NE(readFile(log).find(message), std::string::npos) << readFile(log);
  }
}

}  // namespace
}  // namespace uncertainty_identification

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "fault_detection_test");
  ros::NodeHandle node;
  return RUN_ALL_TESTS();
}
