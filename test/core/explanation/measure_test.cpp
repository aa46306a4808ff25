// What is measured on experiments not used for fitting.
#include "explanation/measure.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/example1.h"
#include "support/hidden.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {
namespace {

/// A dead zone, and sensors that each experiment finds at another zero.
TEST(Measure, SimulationsStartFromTheExperimentsOwnOffset) {
  std::vector<Experiment> experiments = example1BehindDeadZone(20, 0.4);
  double offset = 0;
  for (Experiment& experiment : experiments) experiment.y.array() += offset += 20;
  Configuration configuration = example1Configuration();
  configuration.estimation.offsets = Offsets::per_experiment;
  const Explanation explanation = explain(configuration, experiments);
  ASSERT_FALSE(explanation.causes.empty());
  const Gain gain = explanation.causes.front().gain.value();
  // the offsets spread by 115, which from rest makes a fit below 0; taken from the first 23 samples
  // they are wrong by a good part of the noise, which costs some coverage
  EXPECT_GT(gain.nrmse_fit_percent.before, 90);
  EXPECT_GT(gain.nrmse_fit_percent.after, 90);
  EXPECT_GT(gain.coverage_95.after, 0.8);
}

using test::vectorOf;

/// Worked by hand: squares 2 and 48 about the means 2 and 4, with 1 + 3 degrees of freedom.
TEST(Measure, GainsSpreadAsThoseOfTheExperimentsFittedToDoToo) {
  const MeanGain gain = meanGain({vectorOf({1, 3}), vectorOf({2, 2, 2, 10})});
  EXPECT_DOUBLE_EQ(gain.value, 2);
  EXPECT_DOUBLE_EQ(gain.standard_error, std::sqrt((2 + 48) / 4.0 / 2));
  EXPECT_NEAR(gain.upper_90 - gain.value, 2.1318 * gain.standard_error, 1e-3);  // t, 4 degrees
  EXPECT_DOUBLE_EQ(gain.lower_90 + gain.upper_90, 4);
}

TEST(Measure, GainsOfOneExperimentHaveAnErrorOnlyIfOthersTellIt) {
  EXPECT_TRUE(std::isnan(meanGain({vectorOf({1}), {}}).standard_error));
  EXPECT_TRUE(std::isnan(meanGain({vectorOf({1}), vectorOf({2})}).upper_90));
  EXPECT_DOUBLE_EQ(meanGain({vectorOf({1}), vectorOf({2, 4})}).standard_error, std::sqrt(2.0));
}

}  // namespace
}  // namespace uncertainty_identification
