#include "session/result_overview.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/example1.h"
#include "support/plain_estimate.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

TEST(ResultOverview, HasNumbersAndRunsOfTheExperimentsThatWereUsed) {
  const auto experiments = example1Experiments(8);
  std::vector<KeptExperiment> kept;
  for (const Experiment& experiment : experiments)
    kept.push_back({kept.size() + 1, std::make_shared<const Experiment>(experiment)});
  const std::vector<Experiment> used(experiments.begin(), experiments.end() - 1);
  Result result{Identifier(example1Configuration()).identify(used), {}};
  addOverview(kept, &result);
  EXPECT_FALSE(result.physical.sentence.empty());
  const auto gain = findNumber(result.physical, "gain");
  ASSERT_TRUE(gain);
  EXPECT_TRUE(gain->lower && gain->upper);
  EXPECT_LE(*gain->lower, gain->value);
  ASSERT_EQ(result.runs.size(), 3U);
  for (const SimulatedRun& run : result.runs) EXPECT_NE(run.id, experiments.back().id);
  EXPECT_EQ(typicalFit(result.runs), result.runs[1].fit_percent);
}

TEST(ResultOverview, LeavesIntervalsOutWhereThePlantsHaveNoDistribution) {
  Result result{test::plainEstimate(Eigen::VectorXd::Ones(1), Eigen::VectorXd::Constant(1, -1.5)),
                {}};
  addOverview({}, &result);
  EXPECT_FALSE(result.physical.numbers.empty());
  for (const PhysicalNumber& number : result.physical.numbers) EXPECT_FALSE(number.spread);
  EXPECT_TRUE(std::isnan(typicalFit(result.runs)));
}

TEST(FindNumber, TakesTheSlowestOfSeveral) {
  const PhysicalNumbers physical{
      "", {{"time_constant_1", "s", 3}, {"time_constant_2", "s", 1}, {"dead_time", "s", 0}}};
  EXPECT_EQ(findNumber(physical, "time_constant")->value, 3);
  EXPECT_EQ(findNumber(physical, "dead_time")->value, 0);
  EXPECT_FALSE(findNumber(physical, "gain"));
}

TEST(TypicalFit, IsThatOfTheFirstOfTwo) {
  SimulatedRun best, worst;
  best.rank = "best";
  best.fit_percent = 90;
  worst.rank = "worst";
  worst.fit_percent = 50;
  EXPECT_EQ(typicalFit({best, worst}), 90);
}

}  // namespace
}  // namespace uncertainty_identification
