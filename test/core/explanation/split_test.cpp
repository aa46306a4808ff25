// Which experiments explain fits to and which it measures on.
#include "explanation/split.h"

#include <gtest/gtest.h>

#include "support/core_setup.h"
#include "support/error_message.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

Split tenAndTwo() {
  return {test::example1(2, 10).experiments, test::example1(3, 2).experiments, false};
}

std::string ids(const std::vector<RejectedExperiment>& rejected) {
  std::string all;
  for (const RejectedExperiment& each : rejected) all += each.id + " ";
  return all;
}

TEST(LeaveOutUnusable, LeavesAllThatAreGood) {
  Split data = tenAndTwo();
  EXPECT_TRUE(leaveOutUnusable({}, &data).empty());
  EXPECT_EQ(data.train.size(), 10u);
  EXPECT_EQ(data.held.size(), 2u);
}

TEST(LeaveOutUnusable, TakesTheSampleTimeOfMostThatAreFittedTo) {
  Split data = tenAndTwo();
  data.train[4].id = "slow";
  data.train[4].sample_time *= 10;
  data.held[0].id = "slow too";
  data.held[0].sample_time *= 10;
  const auto rejected = leaveOutUnusable({}, &data);
  EXPECT_EQ(ids(rejected), "slow slow too ");
  EXPECT_NE(rejected[1].reason.find("sample time"), std::string::npos) << rejected[1].reason;
  EXPECT_EQ(data.train.size(), 9u);
  EXPECT_EQ(data.held.size(), 1u);
}

TEST(LeaveOutUnusable, KeepsFewExperimentsThatServeForBoth) {
  Split data;
  data.train = data.held = test::example1(2, 3).experiments;
  data.fitted_to = true;
  data.train[1].y.setConstant(2);
  EXPECT_EQ(leaveOutUnusable({}, &data).size(), 1u);
  EXPECT_EQ(data.held.size(), 2u);
}

TEST(LeaveOutUnusable, HoldsOutAStepFromTheFirstSampleOn) {
  Split data = tenAndTwo();
  data.held.resize(1);
  data.held[0].u.setConstant(2.5);
  EXPECT_TRUE(leaveOutUnusable({}, &data).empty()) << "the fitted ones have another input";
}

TEST(LeaveOutUnusable, SaysWhyNothingIsLeft) {
  Split data = tenAndTwo();
  for (Experiment& experiment : data.held) experiment.sample_time *= 10;
  const std::string message = messageOf<DataError>([&] { leaveOutUnusable({}, &data); });
  EXPECT_NE(message.find("to hold out"), std::string::npos) << message;
  EXPECT_NE(message.find("sample time"), std::string::npos) << message;
}

/// Half of the runs are free responses, which show nothing of the input.
TEST(SplitUsable, HoldsOutOnlyWhatIsUsable) {
  std::vector<Experiment> all = test::example1(2, 8).experiments;
  for (std::size_t k = 0; k < all.size(); k += 2) all[k].u.setZero();
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Configuration configuration;
    configuration.estimation.seed = seed;
    std::vector<RejectedExperiment> rejected;
    const Split data = splitUsable(configuration, all, {}, &rejected);
    EXPECT_EQ(rejected.size(), 4u);
    EXPECT_EQ(data.train.size() + data.held.size(), 4u);
    EXPECT_GE(data.held.size(), 1u);
  }
}

}  // namespace
}  // namespace uncertainty_identification
