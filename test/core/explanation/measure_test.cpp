// What is measured on experiments not used for fitting.
#include <gtest/gtest.h>

#include "support/example1.h"
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

}  // namespace
}  // namespace uncertainty_identification
