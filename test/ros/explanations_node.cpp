// What the node explains: of its own accord, on request, and how it is told.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <std_srvs/Trigger.h>

#include <filesystem>
#include <string>

#include "io/read_file.h"
#include "ros/bag_writer.h"
#include "ros/message_conversions.h"
#include "ros/parameters.h"
#include "support/example1.h"
#include "support/node_client.h"
#include "support/sent_goal.h"

namespace uncertainty_identification {
namespace {

using messages::Explain;
using Action = messages::ExplainExperimentsAction;
using Goal = messages::ExplainExperimentsGoal;
using Result = messages::ExplainExperimentsResult;
using Sent = SentGoal<Action>;

constexpr int kAfter = 20;  // experiments, as in explanations.test

class ExplanationsTest : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(client_.waitForNode());
    ASSERT_TRUE(actions_.waitForActionServerToStart(ros::Duration(60)));
    ASSERT_TRUE(waitFor([this] { return experiment_.getNumSubscribers() > 0; }));
    ASSERT_TRUE(client_.call<std_srvs::Trigger>("reset").success);
  }

  void send(const std::vector<Experiment>& experiments) {
    for (const auto& experiment : experiments) experiment_.publish(toMessage(experiment));
  }

  diagnostic_msgs::DiagnosticStatus diagnosis() const {
    for (const auto& status : diagnostics_.get().status)
      if (status.name == "identification: explanation") return status;
    return {};
  }

  bool diagnosisReaches(int level) {
    return waitFor([&] {
      const auto status = diagnosis();
      return !status.name.empty() && status.level == level;
    });
  }

  NodeClient client_;
  actionlib::ActionClient<Action> actions_{"/identification/explain_experiments"};
  ros::NodeHandle node_;
  ros::Publisher experiment_ =
      node_.advertise<messages::Experiment>("/identification/experiment", 1000);
  Latest<messages::Explanation> explanation_{"/identification/explanation"};
  Latest<diagnostic_msgs::DiagnosticArray> diagnostics_{"/diagnostics"};
};

TEST_F(ExplanationsTest, OfItsOwnAccordAfterSoManyExperiments) {
  EXPECT_TRUE(diagnosisReaches(diagnostic_msgs::DiagnosticStatus::OK));
  const ros::Time begin = ros::Time::now();
  const auto experiments = example1BehindDeadZone(kAfter, 0.4);
  send(experiments);
  ASSERT_TRUE(waitFor([&] { return explanation_.get().header.stamp >= begin; }));
  const messages::Explanation explanation = explanation_.get();
  ASSERT_GE(explanation.causes.size(), 1U) << explanation.message;
  EXPECT_EQ(explanation.causes[0].name, "act_deadzone");
  EXPECT_GE(explanation.sequence, 1U);
  ASSERT_TRUE(diagnosisReaches(diagnostic_msgs::DiagnosticStatus::WARN));
  EXPECT_NE(diagnosis().message.find("act_deadzone"), std::string::npos) << diagnosis().message;
  ASSERT_TRUE(client_.call<std_srvs::Trigger>("reset").success);
  EXPECT_TRUE(diagnosisReaches(diagnostic_msgs::DiagnosticStatus::OK));
}

TEST_F(ExplanationsTest, OnRequestByTheService) {
  EXPECT_EQ(client_.call<Explain>("explain").code, Explain::Response::DATA_ERROR);
  send(example1BehindDeadZone(kAfter - 2, 0.4));  // too few for the node to begin by itself
  ASSERT_TRUE(client_.waitUntilStored(kAfter - 2));
  const auto response = client_.call<Explain>("explain");
  ASSERT_EQ(response.code, Explain::Response::OK) << response.message;
  ASSERT_GE(response.explanation.causes.size(), 1U) << response.message;
  EXPECT_TRUE(waitFor([&] {
    return explanation_.get().header.stamp == response.explanation.header.stamp;
  })) << "it is published too";
}

TEST_F(ExplanationsTest, OnRequestByTheAction) {
  const std::string folder = loadParameters(ros::NodeHandle("/identification")).bag_directory;
  std::filesystem::create_directories(folder);
  writeBag(folder + "/behind_dead_zone.bag", example1BehindDeadZone(kAfter, 0.4));
  Goal goal;
  goal.bags = {"behind_dead_zone.bag"};
  goal.configuration = readFile(PROJECT_FOLDER "/config/example1.yaml");  // cut by a topic
  Sent sent(actions_, goal);
  ASSERT_TRUE(waitFor([&] { return sent.ended(); }));
  const Result result = sent.result();
  ASSERT_EQ(result.code, Result::OK) << result.message;
  EXPECT_EQ(sent.state(), actionlib::TerminalState::SUCCEEDED);
  ASSERT_GE(result.explanation.causes.size(), 1U) << result.message;
  EXPECT_EQ(result.explanation.sequence, 0U);
  ASSERT_FALSE(sent.feedback().empty());
  EXPECT_EQ(sent.feedback().front().phase, "reading bags");
  EXPECT_NE(explanation_.get().header.stamp, result.explanation.header.stamp)
      << "of other experiments than the node's";

  Sent cancelled(actions_, goal);
  ASSERT_TRUE(waitFor([&] { return !cancelled.feedback().empty() || cancelled.ended(); }));
  cancelled.cancel();
  ASSERT_TRUE(waitFor([&] { return cancelled.ended(); }));
  EXPECT_EQ(cancelled.state(), actionlib::TerminalState::PREEMPTED);
  EXPECT_EQ(cancelled.result().code, Result::CANCELLED);
}

}  // namespace
}  // namespace uncertainty_identification

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "explanations_test");
  ros::NodeHandle node;
  return RUN_ALL_TESTS();
}
