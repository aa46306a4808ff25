// Readings that stray from their neighbours count as missing, in what is fitted to and validated
// on.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/example1.h"
#include "uncertainty_identification/bounds/simulated_runs.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

std::vector<Experiment> withStray(std::vector<Experiment> experiments,
                                  const std::vector<int>& samples) {
  for (Experiment& experiment : experiments)
    for (const int t : samples) experiment.y[t] += 20 * experiment.y.cwiseAbs().maxCoeff();
  return experiments;
}

bool warns(const Estimate& estimate, const std::string& text) {
  return std::any_of(
      estimate.warnings.begin(), estimate.warnings.end(),
      [&](const std::string& warning) { return warning.find(text) != std::string::npos; });
}

TEST(WithoutStrayReadings, AllStepsAgreeWithThoseOfCleanData) {
  const std::vector<Experiment> all = example1Experiments(9);
  const std::vector<Experiment> train(all.begin(), all.end() - 1), held(all.end() - 1, all.end());
  const Identifier identifier(example1Configuration());
  const Estimate clean = identifier.identify(train, held);
  // One reading alone would not count among the experiments to validate on.
  const std::vector<Experiment> stray_train = withStray(train, {50, 90}),
                                stray_held = withStray(held, {70});
  const Estimate estimate = identifier.identify(stray_train, stray_held);
  EXPECT_TRUE(warns(estimate, "16 single readings of the output"));
  EXPECT_TRUE(warns(estimate, "validation: 1 single readings"));
  EXPECT_FALSE(warns(clean, "stray"));
  // 16 samples of 1,200 say a little more or less.
  const double variance = clean.noise_variance.value;
  EXPECT_NEAR(estimate.noise_variance.value, variance, 0.1 * variance);
  EXPECT_NEAR(estimate.validation.simulation_fit_percent_pooled,
              clean.validation.simulation_fit_percent_pooled, 3);
  const PredictionCalibration calibration = identifier.calibrate(estimate, stray_train);
  const PredictionCalibration of_clean = identifier.calibrate(clean, train);
  ASSERT_EQ(calibration.radius.size(), of_clean.radius.size());
  EXPECT_NEAR(calibration.radius.front(), of_clean.radius.front(), 0.2 * of_clean.radius.front());
  const auto runs = simulatedRuns(estimate, nullptr, stray_train, stray_held),
             clean_runs = simulatedRuns(clean, nullptr, train, held);
  ASSERT_EQ(runs.size(), clean_runs.size());
  for (std::size_t k = 0; k < runs.size(); ++k)
    EXPECT_NEAR(runs[k].fit_percent, clean_runs[k].fit_percent, 5) << runs[k].rank;
}

TEST(WithoutStrayReadings, UnlessTheUserKeepsThem) {
  Configuration keeping = example1Configuration();
  keeping.limits.max_stray = 0;
  const Estimate estimate =
      Identifier(keeping).identify(withStray(example1Experiments(8), {50, 90}));
  EXPECT_FALSE(warns(estimate, "stray"));
}

}  // namespace
}  // namespace uncertainty_identification
