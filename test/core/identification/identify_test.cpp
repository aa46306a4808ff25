// How an identification ends where the data or the options leave little to do. Data: Example 1.
#include "identification/identify.h"

#include <gtest/gtest.h>

#include "support/core_setup.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

Configuration simulated() {
  Configuration configuration = test::example1Configuration();
  configuration.nominal_model.fit = PlantFit::simulation;
  return configuration;
}

/// Outputs so large that their squares overflow: the likelihood is finite at no start.
std::vector<Experiment> overflowing() {
  std::vector<Experiment> experiments = test::example1(1, 10).experiments;
  for (Experiment& experiment : experiments) experiment.y *= 1e200;
  return experiments;
}

TEST(Identify, WithoutAStartTheDataCannotAnswer) {
  EXPECT_THROW(identify({simulated(), {}, {}}, overflowing(), {}), DataError);
  EXPECT_THROW(identify({test::example1Configuration(), {}, {}}, overflowing(), {}), DataError);
}

TEST(Identify, AFoldWithoutAStartIsTold) {
  const Estimate estimate = identify({simulated(), {}, {}}, test::example1(1, 10).experiments, {});
  EXPECT_THROW(identifyPlant({estimate.configuration, {}, {}, &estimate}, overflowing()),
               DataError);
}

TEST(Identify, TakesNoMoreIterationsThanAsked) {
  Configuration configuration = test::example1Configuration();
  configuration.estimation.max_iterations = 1;
  const Estimate estimate =
      identify({configuration, {}, {}}, test::example1(1, 40).experiments, {});
  EXPECT_EQ(estimate.iterations, 1);
  EXPECT_EQ(estimate.termination, Termination::iteration_limit) << estimate.message;
}

TEST(Identify, DoesNotEditTheCallersConfiguration) {
  Request request{test::example1Configuration(), {}, {}};
  request.configuration.error_model.components = kAutomatic;
  const Estimate estimate = identify(request, test::example1(1, 20).experiments, {});
  EXPECT_EQ(request.configuration.error_model.components, kAutomatic);
  EXPECT_NE(estimate.configuration.error_model.components, kAutomatic);
}

TEST(ProgressPhases, NeverDecreasesAndStaysCancelled) {
  std::vector<double> fractions;
  ProgressPhases progress([&](const Progress& now) {
    fractions.push_back(now.fraction);
    return fractions.size() != 3;
  });
  EXPECT_TRUE(progress.report(Phase::check, 0));
  EXPECT_TRUE(progress.report(Phase::optimum, 0.5, -1.0));
  EXPECT_FALSE(progress.report(Phase::start, 0)) << "cancelled";
  EXPECT_FALSE(progress.report(Phase::errors, 1));
  EXPECT_TRUE(progress.mustEnd());
  ASSERT_EQ(fractions.size(), 3U) << "who has cancelled is not asked again";
  EXPECT_EQ(fractions[0], 0);
  EXPECT_EQ(fractions[2], fractions[1]);
  EXPECT_TRUE(progress.cancelled());
}

}  // namespace
}  // namespace uncertainty_identification
