#include "own_simulation/change_search.h"

#include <gtest/gtest.h>

#include <cmath>

#include "own_simulation/describe_change.h"
#include "support/own_machine.h"

namespace uncertainty_identification {
namespace {

/// The pendulum with a machine that differs; the last six experiments are held out.
class ChangeSearching : public testing::Test {
 protected:
  ChangeSearchResult searched(const Eigen::Vector3d& values, const MachineOptions& options = {},
                              const ChangeSearchLimits& limits = {}) {
    experiments_ = recordMachine(pendulum_, values, options);
    held_experiments_.assign(experiments_.end() - 6, experiments_.end());
    experiments_.resize(experiments_.size() - 6);
    data_ = comparedData(experiments_, 0, 1);
    held_ = comparedData(held_experiments_, 0, 1);
    const ChangedSimulation changed(runs_, data_);
    return searchChanges(changed, data_, held_, limits);
  }

  PendulumSimulation pendulum_;
  SimulationRuns runs_{pendulum_, 100000, {}};
  std::vector<Experiment> experiments_, held_experiments_;
  ComparedData data_, held_;
};

TEST_F(ChangeSearching, TakesTheChangeThatExplainsAllAndNoMore) {
  const ChangeSearchResult result = searched({1.0, 0.6, 0.5});
  ASSERT_EQ(result.found.size(), 1u);
  EXPECT_EQ(result.found[0].change.kind, ChangeKind::parameter);
  EXPECT_EQ(result.found[0].change.parameter, 1) << "the friction";
  EXPECT_NEAR(std::exp(result.fit.changes[0].at[0]), 1.5, 0.01);
  EXPECT_NEAR(result.found[0].held_without, result.held_before.sum(), 1e-9);
  EXPECT_LT(result.held_after.sum(), 0.1 * result.held_before.sum());
}

TEST_F(ChangeSearching, EndsAtTheNumberOfCausesAllowed) {
  ChangeSearchLimits limits;
  limits.max_causes = 1;
  int told = 0;
  limits.tell = [&told](const std::string& what) { told += !what.empty(); };
  const ChangeSearchResult result = searched({1.15, 0.6, 0.5}, {}, limits);
  EXPECT_EQ(result.found.size(), 1u);
  EXPECT_GT(told, 0);
  limits.max_causes = 4;
  EXPECT_EQ(searched({1.15, 0.6, 0.5}, {}, limits).found.size(), 2u);
}

/// The first fourteen runs show a wrong gain, which the other six deny.
TEST_F(ChangeSearching, RefusesWhatHeldOutExperimentsDeny) {
  MachineOptions options;
  options.output_change = [](const Eigen::VectorXd& y, int run) -> Eigen::VectorXd {
    return (run < 14 ? 1.2 : 0.9) * y;
  };
  EXPECT_TRUE(searched({1.0, 0.4, 0.5}, options).found.empty());
}

TEST_F(ChangeSearching, TakesNothingWhereNothingIsWrong) {
  const ChangeSearchResult result = searched({1.0, 0.4, 0.5});
  EXPECT_TRUE(result.found.empty());
  EXPECT_EQ(result.held_before, result.held_after);
}

TEST(LikelyUnit, KnowsTheFactorsThatPeopleForget) {
  EXPECT_EQ(likelyUnit(-1.01), "the opposite sign");
  EXPECT_EQ(likelyUnit(0.01746), "looks like degrees for radians");
  EXPECT_EQ(likelyUnit(57.2), "looks like radians for degrees");
  EXPECT_EQ(likelyUnit(0.1046), "looks like revolutions per minute for rad/s");
  EXPECT_EQ(likelyUnit(1.1), "");
  EXPECT_EQ(likelyUnit(1), "");
}

}  // namespace
}  // namespace uncertainty_identification
