#include "ros/explain_request.h"

#include <gtest/gtest.h>
#include <ros/time.h>

#include <nlohmann/json.hpp>
#include <set>

#include "ros/bag_writer.h"
#include "support/example1.h"
#include "support/temporary_folder.h"

namespace uncertainty_identification {
namespace {

using Goal = messages::ExplainExperimentsGoal;
using Response = messages::ExplainExperimentsResult;

class ExplainRequestTest : public testing::Test {
 protected:
  void SetUp() override {
    ros::Time::init();
    own_.bag_directory = folder_.path();
  }

  ExplainAnswer answer(const Goal& goal, const ProgressCallback& progress) {
    return answerExplain(
        goal, own_, [this] { return kept_; }, 7, progress);
  }

  ExplainAnswer answer(const Goal& goal = {}) {
    return answer(goal, [](const Progress&) { return true; });
  }

  TemporaryFolder folder_;
  Configuration own_ = example1Configuration();
  std::vector<Experiment> kept_;
};

TEST_F(ExplainRequestTest, ExplainsWhatTheNodeKept) {
  kept_ = example1BehindDeadZone(30, 0.4);
  const ExplainAnswer answered = answer();
  ASSERT_EQ(answered.result.code, Response::OK) << answered.result.message;
  const Explanation expected = explain(own_, kept_);
  ASSERT_TRUE(answered.explanation.has_value());
  EXPECT_EQ(answered.explanation->message, expected.message);
  const messages::Explanation& message = answered.result.explanation;
  EXPECT_EQ(answered.result.message, expected.message);
  EXPECT_EQ(message.sequence, 7U);
  ASSERT_GE(message.causes.size(), 1U);
  EXPECT_EQ(message.causes[0].name, "act_deadzone");
  EXPECT_EQ(message.causes[0].parameters[0].value, expected.causes[0].parameters[0].value);
}

TEST_F(ExplainRequestTest, BagsAreAnotherMatterThanWhatTheNodeKept) {
  kept_ = example1BehindDeadZone(30, 0.4);
  writeBag(folder_ / "data.bag", example1Experiments(12));
  Goal goal;
  goal.bags = {"data.bag"};
  const ExplainAnswer answered = answer(goal);
  ASSERT_EQ(answered.result.code, Response::OK) << answered.result.message;
  EXPECT_EQ(answered.result.explanation.sequence, 0U);
  EXPECT_EQ(answered.result.explanation.verdict, messages::Explanation::NONE);
}

TEST_F(ExplainRequestTest, TheConfigurationOfTheGoalCounts) {
  kept_ = example1BehindDeadZone(30, 0.4);
  Goal goal;
  goal.configuration =
      "{nominal_model: {structure: output_error, nb: 1, na: 1, delay: 1}, error_model: {taps: 0},"
      " explanation: {max_causes: 0}}";
  const ExplainAnswer answered = answer(goal);
  ASSERT_EQ(answered.result.code, Response::OK) << answered.result.message;
  EXPECT_EQ(answered.explanation->before.nominal_model.structure, "output_error");
  EXPECT_TRUE(answered.explanation->causes.empty());
}

TEST_F(ExplainRequestTest, EachFailureHasItsCode) {
  const Response nothing = answer().result;
  EXPECT_EQ(nothing.code, Response::DATA_ERROR);
  EXPECT_EQ(nothing.message, "there are no experiments to explain; record some, or name bags");
  Goal goal;
  goal.configuration = "{nominal_modell: {}}";
  EXPECT_EQ(answer(goal).result.code, Response::CONFIGURATION_ERROR);
  goal.configuration.clear();
  goal.bags = {"../data.bag"};
  EXPECT_EQ(answer(goal).result.code, Response::REFUSED);
  goal.bags = {"absent.bag"};
  EXPECT_EQ(answer(goal).result.code, Response::FILE_ERROR);
  EXPECT_FALSE(answer(goal).explanation.has_value());
}

TEST_F(ExplainRequestTest, CancellingEndsIt) {
  kept_ = example1BehindDeadZone(30, 0.4);
  std::set<std::string> phases;
  answer({}, [&phases](const Progress& progress) {
    phases.insert(progress.phase);
    return true;
  });
  ASSERT_GT(phases.size(), 2U);
  for (const std::string& last : phases) {
    const ExplainAnswer cancelled =
        answer({}, [&last](const Progress& progress) { return progress.phase != last; });
    EXPECT_EQ(cancelled.result.code, Response::CANCELLED) << last;
    EXPECT_FALSE(cancelled.explanation.has_value());
  }
}

}  // namespace
}  // namespace uncertainty_identification
