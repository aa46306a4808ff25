// The action ~identify_bags: results, feedback, cancelling, and goals that come while one runs.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <future>
#include <iostream>

#include "ros/bag_writer.h"
#include "ros/parameters.h"
#include "support/example1.h"
#include "support/node_client.h"
#include "support/sent_goal.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

using Goal = messages::IdentifyBagsGoal;
using Result = messages::IdentifyBagsResult;
using Client = actionlib::ActionClient<messages::IdentifyBagsAction>;

using Sent = SentGoal<messages::IdentifyBagsAction>;

class ActionsTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const std::string folder = loadParameters(ros::NodeHandle("/identification")).bag_directory;
    std::filesystem::create_directories(folder);
    writeBag(folder + "/short.bag", example1Experiments(8));
    writeBag(folder + "/long.bag", example1Experiments(400));
  }

  void SetUp() override {
    ASSERT_TRUE(client_.waitForNode());
    ASSERT_TRUE(actions_.waitForActionServerToStart(ros::Duration(60)));
  }

  static Goal goalFor(const std::string& bag, const std::string& configuration = "") {
    Goal goal;
    goal.bags = {bag};
    goal.configuration = configuration;
    return goal;
  }

  static Goal longGoal() {
    return goalFor("long.bag", "{nominal_model: {orders: auto}, error_model: {taps: auto}}");
  }

  NodeClient client_;
  Client actions_{"/identification/identify_bags"};
};

TEST_F(ActionsTest, AGoalGivesWhatTheIdentifierGives) {
  Sent sent(actions_, goalFor("short.bag"));
  ASSERT_TRUE(waitFor([&] { return sent.ended(); }));
  EXPECT_EQ(sent.state(), actionlib::TerminalState::SUCCEEDED);
  const Result result = sent.result();
  ASSERT_EQ(result.code, Result::OK) << result.message;
  const Estimate expected =
      Identifier(loadParameters(client_.node())).identify(example1Experiments(8));
  EXPECT_EQ(result.result.fingerprint, expected.data_fingerprint);
  EXPECT_NEAR(result.result.log_likelihood, expected.log_likelihood,
              1e-9 * std::abs(expected.log_likelihood));
  EXPECT_EQ(client_.call<messages::ListExperiments>("list_experiments").experiments.size(), 0U)
      << "the node's own experiments are another matter";
}

TEST_F(ActionsTest, FeedbackTellsHowFarItIs) {
  Sent sent(actions_, longGoal());
  ASSERT_TRUE(waitFor([&] {
    const auto heard = sent.feedback();
    return (heard.size() > 10 && heard.back().phase != "reading bags") || sent.ended();
  }));
  sent.cancel();
  ASSERT_TRUE(waitFor([&] { return sent.ended(); }));
  const auto feedback = sent.feedback();
  ASSERT_GT(feedback.size(), 10U);
  EXPECT_EQ(feedback.front().phase, "reading bags");
  EXPECT_TRUE(std::isnan(feedback.front().log_likelihood));
  EXPECT_NE(feedback.back().phase, "reading bags");
  for (std::size_t i = 1; i < feedback.size(); ++i) {
    EXPECT_GE(feedback[i].fraction, feedback[i - 1].fraction);
    EXPECT_LE(feedback[i].fraction, 1);
  }
}

// Cancelled at moments spread over reading and identifying; the time is what is asked for.
TEST_F(ActionsTest, CancellingTakesLessThan100Milliseconds) {
  double longest = 0;
  for (std::size_t heard = 1; heard <= 20; ++heard) {
    Sent sent(actions_, longGoal());
    ASSERT_TRUE(waitFor([&] { return sent.feedback().size() >= heard || sent.ended(); }));
    const auto begin = std::chrono::steady_clock::now();
    sent.cancel();
    ASSERT_TRUE(waitFor([&] { return sent.ended(); }));
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    longest = std::max(longest, took.count());
    EXPECT_EQ(sent.state(), actionlib::TerminalState::PREEMPTED);
    EXPECT_EQ(sent.result().code, Result::CANCELLED);
  }
  std::cout << "longest of 20 cancellations: " << 1000 * longest << " ms\n";
  EXPECT_LT(longest, 0.1);
}

// The largest orders that a configuration allows: minutes of work, which no goal after it waits
// for.
TEST_F(ActionsTest, TheGoalAfterACancelledOneBeginsAtOnce) {
  const Goal largest =
      goalFor("long.bag", "{nominal_model: {nb: 50, na: 50, nc: 50, nd: 50, delay: 1}}");
  for (const int heard : {1, 3, 10, 40}) {
    Sent sent(actions_, largest);
    const auto count = static_cast<std::size_t>(heard);
    ASSERT_TRUE(waitFor([&] { return sent.feedback().size() >= count || sent.ended(); }));
    sent.cancel();
    ASSERT_TRUE(waitFor([&] { return sent.ended(); }));
    EXPECT_EQ(sent.result().code, Result::CANCELLED);
    const auto begin = std::chrono::steady_clock::now();
    Sent next(actions_, goalFor("short.bag"));
    ASSERT_TRUE(waitFor([&] { return !next.feedback().empty() || next.ended(); }));
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    EXPECT_LT(took.count(), 2) << "after " << heard << " feedbacks";
    ASSERT_TRUE(waitFor([&] { return next.ended(); }));
    EXPECT_EQ(next.result().code, Result::OK) << next.result().message;
  }
}

TEST_F(ActionsTest, TheStatusNamesWhatRunsAndSinceWhen) {
  const ros::Time before = ros::Time::now();
  Sent sent(actions_, longGoal());
  ASSERT_TRUE(waitFor([&] { return !client_.status().running.empty(); }));
  const auto status = client_.status();
  EXPECT_EQ(status.running.front(), "identifying from 1 bags (~identify_bags)");
  ASSERT_EQ(status.running_since.size(), status.running.size());
  EXPECT_GE(status.running_since.front(), before);
  EXPECT_LE(status.running_since.front(), ros::Time::now());
  sent.cancel();
  EXPECT_TRUE(waitFor([&] { return client_.status().running.empty(); }));
}

TEST_F(ActionsTest, TheStatusCountsTheRequestsThatWait) {
  const auto ask = [&] {
    messages::Identify::Request request;
    request.bags = {"long.bag"};
    request.configuration =
        "{nominal_model: {nb: 50, na: 50, nc: 50, nd: 50, delay: 1}, estimation: {time_limit: 2}}";
    return std::async(std::launch::async,
                      [=] { return client_.call<messages::Identify>("identify", request).code; });
  };
  auto first = ask(), second = ask();
  EXPECT_TRUE(waitFor([&] { return client_.status().waiting_requests == 1; }));
  first.wait();
  second.wait();
  EXPECT_TRUE(waitFor([&] { return client_.status().waiting_requests == 0; }));
  EXPECT_NE(first.get(), messages::Identify::Response::INTERNAL_ERROR);
}

TEST_F(ActionsTest, ANewGoalPreemptsTheOneThatRuns) {
  Sent first(actions_, longGoal());
  ASSERT_TRUE(waitFor([&] { return !first.feedback().empty(); }));
  Sent second(actions_, goalFor("short.bag"));
  ASSERT_TRUE(waitFor([&] { return first.ended() && second.ended(); }));
  EXPECT_EQ(first.state(), actionlib::TerminalState::PREEMPTED);
  EXPECT_EQ(first.result().code, Result::CANCELLED);
  EXPECT_EQ(second.state(), actionlib::TerminalState::SUCCEEDED);
}

TEST_F(ActionsTest, BadGoalsAreAbortedWithACode) {
  const std::vector<std::pair<Goal, int>> cases = {
      {Goal(), Result::DATA_ERROR},
      {goalFor("../short.bag"), Result::REFUSED},
      {goalFor("absent.bag"), Result::FILE_ERROR},
      {goalFor("short.bag", "{nominal_modell: {}}"), Result::CONFIGURATION_ERROR}};
  for (const auto& [goal, code] : cases) {
    Sent sent(actions_, goal);
    ASSERT_TRUE(waitFor([&] { return sent.ended(); }));
    EXPECT_EQ(sent.state(), actionlib::TerminalState::ABORTED);
    EXPECT_EQ(static_cast<int>(sent.result().code), code);
    EXPECT_FALSE(sent.result().message.empty());
  }
}

}  // namespace
}  // namespace uncertainty_identification

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "actions_test");
  ros::NodeHandle node;
  return RUN_ALL_TESTS();
}
