// The live page and ~summary of a running node: results arrive by themselves, a hostile client does
// not disturb the recording, and the node ends in time whatever is connected.

#include <gtest/gtest.h>
#include <std_srvs/Trigger.h>

#include <cmath>

#include "live/live_server.h"
#include "support/example1.h"
#include "support/http_attack.h"
#include "support/http_connection.h"
#include "support/node_client.h"
#include "support/node_process.h"
#include "support/resident_memory.h"
#include "support/signal_publisher.h"

namespace uncertainty_identification {
namespace {

class LivePageNodeTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!liveServerObstacle().empty()) GTEST_SKIP() << liveServerObstacle();
    ros::param::set("/identification/live_page/port", port_);
    node_.start();
    ASSERT_TRUE(client_.waitForNode());
    signals_ = std::make_unique<SignalPublisher>(client_);
    ASSERT_TRUE(waitFor([this] { return answers(); }));
  }

  bool answers() {
    try {
      return answerTo(port_, getRequest("/")).rfind("HTTP/1.1 200 ", 0) == 0;
    } catch (const std::runtime_error&) {
      return false;
    }
  }

  std::vector<messages::ExperimentSummary> listed() {
    return client_.call<messages::ListExperiments>("list_experiments").experiments;
  }

  /// Publishes samples at 1 kHz with stamps on a grid, as one experiment.
  void record(int samples) {
    ASSERT_TRUE(signals_->trigger("start_experiment"));
    messages::Sample sample;
    const ros::Time begin = ros::Time::now();
    for (int k = 0; k < samples; ++k) {
      sample.header.stamp = begin + ros::Duration(k * 0.001);
      ros::Time::sleepUntil(sample.header.stamp);
      sample.value = (k / 50) % 2;
      command_.publish(sample);
      measurement_.publish(sample);
    }
    ASSERT_TRUE(signals_->trigger("finish_experiment"));
  }

  const int port_ = freePort();
  NodeProcess node_;
  NodeClient client_;
  std::unique_ptr<SignalPublisher> signals_;
  ros::NodeHandle handle_;
  ros::Publisher command_ = handle_.advertise<messages::Sample>("/actuator/command", 100000);
  ros::Publisher measurement_ = handle_.advertise<messages::Sample>("/sensor/measurement", 100000);
};

TEST_F(LivePageNodeTest, AResultArrivesByItselfAndInSingleNumbers) {
  const Latest<messages::Summary> summary("/identification/summary");
  HttpConnection browser(port_);
  browser.send(getRequest("/events"));
  EXPECT_NE(browser.receiveUntil("event: experiments").find("event: status"), std::string::npos);
  for (const auto& experiment : example1Experiments(3)) ASSERT_TRUE(signals_->record(experiment));
  ASSERT_TRUE(client_.waitUntilStored(3)) << client_.told();
  const std::uint32_t sequence = client_.status().sequence;
  const std::string last = "\"sequence\":" + std::to_string(sequence) + ",";
  EXPECT_NE(browser.receiveUntil("event: result").find("\"physical\""), std::string::npos);
  EXPECT_NE(browser.receiveUntil(last).find(last), std::string::npos);

  ASSERT_TRUE(waitFor([&] { return summary.get().sequence == sequence; }));
  const messages::Summary now = summary.get();
  const auto model = client_.call<messages::GetResult>("get_result").result.nominal_model;
  double b = 0, a = 1;
  for (const double value : model.b) b += value;
  for (const double value : model.a) a += value;
  EXPECT_NEAR(now.static_gain.value, b / a, 1e-9 * std::abs(b / a));
  EXPECT_LE(now.static_gain.lower, now.static_gain.value);
  EXPECT_GE(now.static_gain.upper, now.static_gain.value);
  EXPECT_EQ(now.noise_standard_deviation, std::sqrt(model.noise_variance));
  EXPECT_EQ(now.dead_time.value, 0);
  EXPECT_LE(now.fit, 100) << "and not unknown";
  EXPECT_EQ(now.accepted, 3U);
  EXPECT_EQ(now.rejected, 0U);
}

TEST_F(LivePageNodeTest, AHostileClientDoesNotDisturbTheRecording) {
  constexpr int kSamples = 10000;  // ten seconds
  const auto recordAttacked = [this] {
    const HttpAttack attack(port_, 200, 1000);
    record(kSamples);
    EXPECT_TRUE(waitFor([&] { return attack.sent() == 1000; }));
  };
  const auto memoryAfter = [&](std::size_t experiments) {
    recordAttacked();
    EXPECT_TRUE(waitFor([&] { return listed().size() == experiments; }));
    EXPECT_TRUE(waitFor([this] { return client_.status().running.empty(); }));
    return residentMemory(node_.id());
  };
  double before = memoryAfter(1), now = memoryAfter(2);  // threads and caches come into being first
  for (const auto& experiment : listed()) {
    EXPECT_EQ(experiment.input.lost, 0U);
    EXPECT_EQ(experiment.output.lost, 0U);
    EXPECT_GE(experiment.samples, static_cast<unsigned>(kSamples - 1));
  }
  constexpr double kMost = 15;  // [MB]
  // A thread may get its own heap of malloc at the second attack; what leaks grows at each.
  if (now - before >= kMost) {
    before = now;
    now = memoryAfter(3);
  }
  EXPECT_LT(now - before, kMost) << "of which the experiment and its result take some";
  EXPECT_TRUE(waitFor([this] { return answers(); }));
}

TEST_F(LivePageNodeTest, TheNodeEndsInTimeWithOpenConnections) {
  std::vector<std::unique_ptr<HttpConnection>> clients;
  for (int k = 0; k < 40; ++k) {
    clients.push_back(std::make_unique<HttpConnection>(port_));
    clients.back()->send(k % 2 == 0 ? getRequest("/events") : "GET /");
  }
  clients.front()->receiveUntil("event: status");
  const auto began = std::chrono::steady_clock::now();
  EXPECT_EQ(node_.interrupt().status, 0);
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(5));
  node_.start();  // to be ended by the test
}

TEST_F(LivePageNodeTest, ATakenPortIsRefusedAtTheStart) {
  const auto refused = runProcess({std::string(TOOLS_FOLDER) + "/identification_node",
                                   "__name:=second", "_live_page/port:=" + std::to_string(port_)});
  EXPECT_EQ(refused.status, 2);
  const std::string told = refused.output + refused.errors;
  EXPECT_NE(told.find("live_page.port: found " + std::to_string(port_)), std::string::npos) << told;
}

}  // namespace
}  // namespace uncertainty_identification

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "live_page_test");
  ros::NodeHandle node;
  return RUN_ALL_TESTS();
}
