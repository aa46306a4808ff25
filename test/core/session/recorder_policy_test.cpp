#include "session/recorder_policy.h"

#include <gtest/gtest.h>

#include <memory>

namespace uncertainty_identification {
namespace {

using std::chrono::milliseconds;

/// A policy on a cutter of experiments that begin and end by calls, and what it tells.
class RecorderPolicyTest : public testing::Test {
 protected:
  void SetUp() override { policy_->reset(now_); }

  static ExperimentOptions byCalls() {
    ExperimentOptions options;
    options.mode = ExperimentMode::service;
    return options;
  }

  RecorderPolicy::Listener listener() {
    return {[this](const FinishedExperiment& finished) { finished_.push_back(finished); },
            [this](const std::string& problem) { problems_.push_back(problem); },
            [this](bool running) { running_.push_back(running); }};
  }

  void input(double stamp) {
    cutter_.addInput(stamp, 1);
    arrived();
  }
  void output(double stamp) {
    cutter_.addOutput(stamp, 1);
    arrived();
  }
  void arrived() {
    policy_->arrived(now_);
    policy_->passOn(cutter_, now_);
  }
  void call(bool begin, double stamp) {
    begin ? cutter_.begin(stamp) : cutter_.finish(stamp);
    policy_->passOn(cutter_, now_);
  }
  void later(int time) {
    now_ += milliseconds(time);
    policy_->releaseLate(cutter_, now_);
  }

  RecorderPolicy::Clock::time_point now_{};
  ExperimentCutter cutter_{byCalls(), LimitOptions()};
  std::vector<FinishedExperiment> finished_;
  std::vector<std::string> problems_;
  std::vector<bool> running_;
  std::unique_ptr<RecorderPolicy> policy_ =
      std::make_unique<RecorderPolicy>(listener(), RecorderPolicy::Patience::until_silence);
};

TEST_F(RecorderPolicyTest, PassesOnOnceBothSignalsHavePassedTheEnd) {
  call(true, 1);
  for (const double stamp : {1.0, 1.5, 2.5}) input(stamp);
  for (const double stamp : {1.0, 1.5}) output(stamp);
  call(false, 2);
  EXPECT_TRUE(finished_.empty()) << "a late output may come";
  output(2.5);
  ASSERT_EQ(finished_.size(), 1U);
  EXPECT_EQ(std::get<Recording>(finished_[0]).output.stamps.size(), 2U);
  EXPECT_EQ(running_, (std::vector<bool>{true, false}));
}

TEST_F(RecorderPolicyTest, PassesOnAfterASecondOfSilence) {
  call(true, 1);
  input(1);
  output(1);
  call(false, 2);
  later(900);
  EXPECT_TRUE(finished_.empty());
  output(1.5);
  later(900);
  EXPECT_TRUE(finished_.empty()) << "a message has arrived since";
  later(100);
  ASSERT_EQ(finished_.size(), 1U);
  EXPECT_EQ(std::get<Recording>(finished_[0]).output.stamps.size(), 2U);
}

TEST_F(RecorderPolicyTest, WithPatienceOfASecondOtherMessagesDoNotProlongIt) {
  policy_ = std::make_unique<RecorderPolicy>(listener(), RecorderPolicy::Patience::a_second);
  policy_->reset(now_);
  call(true, 1);
  input(1);
  output(1);
  call(false, 2);
  for (int k = 1; k <= 9; ++k) {
    output(2 + 0.1 * k);  // the input stays silent
    later(100);
    EXPECT_TRUE(finished_.empty());
  }
  output(3);
  later(100);
  EXPECT_EQ(finished_.size(), 1U);
}

TEST_F(RecorderPolicyTest, PassesOnRejectedAndCompleteExperiments) {
  call(true, 1);
  output(1.5);
  for (const double stamp : {0.5, 0.6, 0.7}) output(stamp);  // the clock goes back
  ASSERT_EQ(finished_.size(), 1U);
  EXPECT_TRUE(std::holds_alternative<RejectedExperiment>(finished_[0]));
  policy_->passOn(Experiment());
  EXPECT_TRUE(std::holds_alternative<Experiment>(finished_.at(1)));
}

TEST_F(RecorderPolicyTest, TellsEachProblemOnceAndAtMostAHundred) {
  for (int k = 0; k < 3; ++k) policy_->report("a topic is silent");
  EXPECT_EQ(problems_.size(), 1U);
  for (int k = 0; k < 200; ++k) policy_->report(std::string(static_cast<std::size_t>(k), 'x'));
  EXPECT_EQ(problems_.size(), 100U);
  policy_->reset(now_);
  policy_->report("a topic is silent");
  EXPECT_EQ(problems_.size(), 101U);
}

TEST_F(RecorderPolicyTest, ResetTellsThatNothingRuns) {
  call(true, 1);
  policy_->reset(now_);
  EXPECT_EQ(running_, (std::vector<bool>{true, false}));
  EXPECT_FALSE(policy_->running());
}

}  // namespace
}  // namespace uncertainty_identification
