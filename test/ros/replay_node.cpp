// A bag of stamped samples, replayed through the node at any rate, paused, or in a loop, gives what
// identifying the bag offline gives.

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosgraph_msgs/Clock.h>
#include <signal.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <nlohmann/json.hpp>

#include "ros/bag_writer.h"
#include "ros/parameters.h"
#include "support/example1.h"
#include "support/node_client.h"
#include "support/process.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/identifier.h"
#include "uncertainty_identification/io/result_json.h"
#include "uncertainty_identification/ros/bag_reader.h"

namespace uncertainty_identification {
namespace {

constexpr int kExperiments = 20;

void expectNear(double actual, double expected, const std::string& what) {
  EXPECT_NEAR(actual, expected, 1e-9 * std::max(1.0, std::abs(expected))) << what;
}

void expectNear(const std::vector<double>& actual, const Eigen::VectorXd& expected,
                const std::string& what) {
  ASSERT_EQ(static_cast<Eigen::Index>(actual.size()), expected.size()) << what;
  for (std::size_t i = 0; i < actual.size(); ++i)
    expectNear(actual[i], expected[static_cast<Eigen::Index>(i)], what);
}

void expectSame(const messages::IdentificationResult& result, const Estimate& expected) {
  EXPECT_FALSE(result.preliminary);
  EXPECT_EQ(result.termination, messages::IdentificationResult::CONVERGED);
  EXPECT_EQ(result.experiment_count, static_cast<unsigned>(expected.experiment_count));
  EXPECT_EQ(result.fingerprint, expected.data_fingerprint);
  expectNear(result.log_likelihood, expected.log_likelihood, "log-likelihood");
  expectNear(result.nominal_model.b, expected.nominal_model.b, "b");
  expectNear(result.nominal_model.a, expected.nominal_model.a, "a");
  expectNear(result.nominal_model.c, expected.nominal_model.c, "c");
  expectNear(result.nominal_model.d, expected.nominal_model.d, "d");
  expectNear(result.nominal_model.noise_variance, expected.noise_variance.value, "noise variance");
  const Mixture& mixture = expected.error_model.mixture;
  ASSERT_EQ(result.error_model.components.size(), mixture.weights.size());
  for (std::size_t i = 0; i < mixture.weights.size(); ++i) {
    expectNear(result.error_model.components[i].weight, mixture.weights[i], "weight");
    expectNear(result.error_model.components[i].mean, mixture.means[i], "mean");
    expectNear(result.error_model.components[i].covariance[0], mixture.covariances[i](0, 0),
               "covariance");
  }
  EXPECT_EQ(estimateFromJson(nlohmann::json::parse(result.result_json)).log_likelihood,
            result.log_likelihood);
}

// A player of bags that runs beside the test until it is stopped.
class Player {
 public:
  explicit Player(const std::string& arguments)
      : process_({"/bin/sh", "-c",
                  "exec rosbag play __name:=player --quiet --clock --queue=10000 "
                  "--wait-for-subscribers " +
                      arguments + " < /dev/null"}) {}

  bool pause(bool paused) {
    std_srvs::SetBool service;
    service.request.data = paused;
    return ros::service::waitForService("/player/pause_playback", 60000) &&
           ros::service::call("/player/pause_playback", service) && service.response.success != 0;
  }

  void stop() { kill(process_.id(), SIGINT); }
  int waitForTheEnd() { return process_.wait().status; }

 private:
  Process process_;
};

class ReplayTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(client_.waitForNode());
    ASSERT_NE(client_.call<std_srvs::Trigger>("reset").success, 0);
    clock_ = client_.node().subscribe<rosgraph_msgs::Clock>(
        "/clock", 1000, [this](const rosgraph_msgs::Clock::ConstPtr& clock) {
          const std::lock_guard<std::mutex> lock(mutex_);
          if (clock->clock < now_) ++passes_;
          now_ = clock->clock;
        });
  }

  ros::Time now() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return now_;
  }

  // How often the clock went back.
  int passes() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return passes_;
  }

  std::vector<messages::ExperimentSummary> listed() {
    return client_.call<messages::ListExperiments>("list_experiments").experiments;
  }

  // The node holds these experiments, and what identifying them offline gives.
  void expectWhatOfflineGives(const std::vector<Experiment>& offline) {
    const auto list = listed();
    ASSERT_GE(list.size(), offline.size());
    for (std::size_t i = 0; i < offline.size(); ++i) {
      EXPECT_EQ(list[i].id, offline[i].id);
      EXPECT_EQ(list[i].samples, static_cast<unsigned>(offline[i].validSamples()));
      EXPECT_EQ(list[i].start.toSec(), offline[i].start_time);
      EXPECT_EQ(list[i].rejected, "");
    }
    const Estimate expected = Identifier(configuration()).identify(offline);
    ASSERT_EQ(expected.termination, Termination::converged);
    const auto answer = client_.call<messages::GetResult>("get_result");
    ASSERT_EQ(answer.code, messages::GetResult::Response::OK) << answer.message;
    expectSame(answer.result, expected);
  }

  // What was not taken for a sample, and why.
  void expectNothingDropped() {
    EXPECT_EQ(client_.told().find("left out"), std::string::npos) << client_.told();
  }

  Configuration configuration() { return loadParameters(client_.node()); }

  TemporaryFolder folder_;
  const std::string bag_ = folder_ / "example1.bag";
  NodeClient client_;
  std::mutex mutex_;
  ros::Time now_;
  int passes_ = 0;
  ros::Subscriber clock_;
};

TEST_F(ReplayTest, TenTimesFasterGivesWhatReadingTheBagGives) {
  writeBag(bag_, example1Experiments(kExperiments));
  ASSERT_EQ(playBag(bag_, "--rate=10"), 0);
  ASSERT_TRUE(client_.waitUntilStored(kExperiments)) << client_.told();
  const auto offline = readBag(bag_, configuration()).experiments;
  EXPECT_EQ(listed().size(), offline.size());
  expectWhatOfflineGives(offline);
  expectNothingDropped();
}

TEST_F(ReplayTest, PausedAndResumedAtRateOneToo) {
  writeBag(bag_, example1Experiments(kExperiments));
  Player player("--rate=1 " + bag_);
  for (const std::uint32_t stored : {2U, 5U}) {
    ASSERT_TRUE(waitFor([&] { return client_.status().stored_count >= stored; }));
    ASSERT_TRUE(player.pause(true));
    const ros::Time paused_at = now();
    ros::WallDuration(2).sleep();  // longer than the silence that ends waiting
    EXPECT_LT((now() - paused_at).toSec(), 0.5) << "the clock stands still";
    ASSERT_TRUE(player.pause(false));
  }
  ASSERT_EQ(player.waitForTheEnd(), 0);
  ASSERT_TRUE(client_.waitUntilStored(kExperiments)) << client_.told();
  const auto offline = readBag(bag_, configuration()).experiments;
  EXPECT_EQ(listed().size(), offline.size());
  expectWhatOfflineGives(offline);
  expectNothingDropped();
}

TEST_F(ReplayTest, LaterPassesOfALoopAddNothing) {
  writeBag(bag_, example1Experiments(kExperiments));
  const auto offline = readBag(bag_, configuration()).experiments;
  Player player("--loop --rate=10 " + bag_);
  ASSERT_TRUE(waitFor([this] { return passes() == 1; }));
  ASSERT_TRUE(client_.waitUntilStored(kExperiments)) << client_.told();
  const auto sequence = client_.status().sequence;
  ASSERT_TRUE(waitFor([this] { return passes() == 3; }));
  player.stop();
  player.waitForTheEnd();
  EXPECT_EQ(listed().size(), offline.size());
  EXPECT_EQ(client_.status().sequence, sequence) << "there was nothing new to identify from";
  expectWhatOfflineGives(offline);
}

// The end of the last marker is missing: the experiment still runs when the bag begins anew.
TEST_F(ReplayTest, AnExperimentTornByTheLoopIsRejectedWithAReason) {
  constexpr int kWhole = 6;
  writeBag(bag_, example1Experiments(kWhole));
  const auto offline = readBag(bag_, configuration()).experiments;
  {
    const double end = offline.back().start_time + 2;
    rosbag::Bag bag(bag_, rosbag::bagmode::Append);
    messages::ExperimentMarker marker;
    marker.active = 1;
    marker.id = "torn";
    marker.header.stamp = ros::Time(end);
    bag.write("/experiment/active", marker.header.stamp, marker);
    messages::Sample sample;
    for (int k = 0; k < 50; ++k) {
      sample.header.stamp = ros::Time(end + 0.01 * k);
      sample.value = k % 7;
      bag.write("/actuator/command", sample.header.stamp, sample);
      bag.write("/sensor/measurement", sample.header.stamp, sample);
    }
  }
  Player player("--loop --rate=5 " + bag_);
  ASSERT_TRUE(waitFor([this] { return passes() == 2; }));
  ASSERT_TRUE(waitFor([this] { return listed().size() > kWhole; }));
  player.stop();
  player.waitForTheEnd();
  ASSERT_TRUE(client_.waitUntilStored(kWhole)) << client_.told();
  EXPECT_EQ(client_.status().stored_count, static_cast<unsigned>(kWhole));
  for (const auto& experiment : listed()) {
    if (experiment.rejected.empty()) continue;
    EXPECT_EQ(experiment.id, "torn");
    EXPECT_NE(experiment.rejected.find("the clock went back"), std::string::npos)
        << experiment.rejected;
  }
  expectWhatOfflineGives(offline);
}

}  // namespace
}  // namespace uncertainty_identification

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "replay_test");
  ros::NodeHandle node;
  return RUN_ALL_TESTS();
}
