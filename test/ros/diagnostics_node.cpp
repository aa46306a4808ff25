// What /diagnostics tells of the node, from its start to a failed experiment.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>

#include <map>

#include "support/example1.h"
#include "support/node_client.h"
#include "support/signal_publisher.h"

namespace uncertainty_identification {
namespace {

using Level = diagnostic_msgs::DiagnosticStatus;

class DiagnosticsTest : public testing::Test {
 protected:
  DiagnosticsTest() {
    subscriber_ = node_.subscribe<diagnostic_msgs::DiagnosticArray>(
        "/diagnostics", 100, [this](const diagnostic_msgs::DiagnosticArray::ConstPtr& array) {
          const std::lock_guard<std::mutex> lock(mutex_);
          for (const auto& status : array->status) statuses_[status.name] = status;
        });
  }

  void SetUp() override { ASSERT_TRUE(client_.waitForNode()); }

  Level part(const std::string& name) {
    const std::lock_guard<std::mutex> lock(mutex_);
    return statuses_["identification: " + name];
  }

  // Waits for the level of a part of the node; `act` happens in between.
  template <typename Act>
  bool reaches(const std::string& name, unsigned char level, const Act& act) {
    return waitFor([&] {
      act();
      const Level status = part(name);
      return !status.name.empty() && status.level == level;
    });
  }

  bool reaches(const std::string& name, unsigned char level) {
    return reaches(name, level, [] {});
  }

  NodeClient client_;
  SignalPublisher signals_{client_};
  ros::NodeHandle node_;
  std::mutex mutex_;
  std::map<std::string, Level> statuses_;  // by name
  ros::Subscriber subscriber_;
};

TEST_F(DiagnosticsTest, FollowTheNode) {
  EXPECT_TRUE(reaches("signals", Level::STALE));
  EXPECT_TRUE(reaches("identification", Level::STALE));

  EXPECT_TRUE(reaches("signals", Level::OK, [this] { signals_.publish(0, 0); }))
      << part("signals").message;
  EXPECT_TRUE(reaches("signals", Level::WARN)) << "silence";
  ASSERT_TRUE(signals_.trigger("start_experiment"));
  EXPECT_TRUE(reaches("signals", Level::ERROR)) << "silence while an experiment runs";
  ASSERT_TRUE(signals_.trigger("discard_experiment"));
  EXPECT_TRUE(reaches("signals", Level::OK, [this] { signals_.publish(0, 0); }));

  for (const auto& experiment : example1Experiments(4)) ASSERT_TRUE(signals_.record(experiment));
  // Stamps of signals sent in a hurry deviate from a grid, so the model may not be trusted.
  EXPECT_TRUE(waitFor([&] {
    const Level status = part("identification");
    return !status.values.empty() && status.values.front().value == "converged";
  })) << part("identification").message;
  const Level done = part("identification");
  EXPECT_EQ(done.values.at(0).key, "termination");
  if (done.level != Level::OK) {
    EXPECT_EQ(done.level, Level::WARN);
    EXPECT_EQ(done.message.find("do not rely on the bounds: "), 0u) << done.message;
  }

  Experiment constant = example1Experiments(1).front();
  constant.u.setZero();
  ASSERT_TRUE(signals_.trigger("reset"));
  EXPECT_TRUE(reaches("identification", Level::STALE));
  ASSERT_TRUE(signals_.record(constant));
  EXPECT_TRUE(reaches("identification", Level::ERROR)) << part("identification").message;
}

}  // namespace
}  // namespace uncertainty_identification

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "diagnostics_test");
  ros::NodeHandle node;
  return RUN_ALL_TESTS();
}
