// How an identification ends that is cancelled or has no time left. Data: Example 1.
#include <gtest/gtest.h>

#include <ctime>

#include "support/core_setup.h"
#include "support/identify_example1.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

/// [s] Processor time of this process, which other programs do not change.
double processorTime() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

constexpr double kMostWork = 0.5;  // [s] of the processor between two questions

/// The largest orders that a configuration may have: minutes of work.
Configuration largestOrders() {
  Configuration configuration;
  NominalModelOptions& nominal = configuration.nominal_model;
  nominal.orders_auto = false;
  nominal.nb = nominal.na = nominal.nc = nominal.nd = 50;
  configuration.estimation.threads = 1;
  return configuration;
}

/// Cancels after so much processor time [s].
class CancelledAfter : public testing::TestWithParam<double> {};

TEST_P(CancelledAfter, TheLargestOrdersEndAtOnce) {
  const double began = processorTime();
  double cancelled = 0;
  const Estimate estimate =
      Identifier(largestOrders()).identify(test::example1Experiments(21), {}, [&](const Progress&) {
        if (processorTime() - began < GetParam()) return true;
        if (cancelled == 0) cancelled = processorTime();
        return false;
      });
  EXPECT_EQ(estimate.termination, Termination::cancelled);
  EXPECT_LT(processorTime() - cancelled, kMostWork);
  EXPECT_LT(cancelled - began, GetParam() + kMostWork) << "it asked late";
}

INSTANTIATE_TEST_SUITE_P(Instants, CancelledAfter, testing::Values(0, 0.05, 0.3, 1, 3, 8));

/// Every choice is automatic, so that all phases take part.
TEST(Cancellation, IsAskedForInEveryPhase) {
  Configuration configuration;
  configuration.estimation.threads = 2;
  configuration.nominal_model.max_order = 4;
  double last = processorTime(), longest = 0;
  std::string phase, phase_of_longest;
  const auto ask = [&](const Progress& now) {
    const double spent = processorTime() - last;
    if (spent > longest) phase_of_longest = phase;
    longest = std::max(longest, spent);
    last += spent;
    phase = now.phase;
    return true;
  };
  const std::vector<Experiment> experiments = test::example1Experiments(12);
  const Identifier identifier(configuration);
  const Estimate estimate = identifier.identify(experiments, test::example1Experiments(3, 9), ask);
  EXPECT_TRUE(estimate.usable());
  identifier.calibrate(estimate, experiments, ask);
  EXPECT_LT(longest, kMostWork) << phase_of_longest;
}

TEST(Cancellation, OfACalibrationLeavesNone) {
  const std::vector<Experiment> experiments = test::example1Experiments(12);
  const Identifier identifier(test::example1Configuration());
  const Estimate estimate = identifier.identify(experiments);
  int asked = 0;
  const auto calibration =
      identifier.calibrate(estimate, experiments, [&](const Progress&) { return ++asked < 20; });
  EXPECT_TRUE(calibration.folds.empty());
}

TEST(TimeLimit, WithoutAModelTheAnswerSaysSo) {
  Configuration configuration = largestOrders();
  configuration.estimation.time_limit = 0.2;
  const double began = processorTime();
  const Estimate estimate = Identifier(configuration).identify(test::example1Experiments(21));
  EXPECT_LT(processorTime() - began, 0.2 + kMostWork);
  EXPECT_EQ(estimate.termination, Termination::time_limit);
  EXPECT_FALSE(estimate.usable());
  EXPECT_NE(estimate.message.find("0.2 s"), std::string::npos) << estimate.message;
  EXPECT_NE(estimate.message.find("estimation.time_limit"), std::string::npos) << estimate.message;
}

/// The search ends with what there is once three quarters of the time are over.
TEST(TimeLimit, TheBestModelSoFarIsGivenAndMarked) {
  Configuration configuration = test::example1Configuration();
  configuration.estimation.tolerance = 1e-300;  // never converges
  configuration.estimation.max_iterations = 1000000;
  configuration.estimation.algorithm = Algorithm::em;
  configuration.estimation.time_limit = 4;
  const Estimate estimate = Identifier(configuration).identify(test::example1Experiments(20));
  EXPECT_EQ(estimate.termination, Termination::time_limit) << estimate.message;
  EXPECT_TRUE(estimate.usable());
  EXPECT_NE(estimate.message.find("the best model"), std::string::npos) << estimate.message;
  EXPECT_FALSE(estimate.trust.trusted);
  EXPECT_GT(estimate.nominal_model.parameters.front().standard_error, 0);
}

TEST(TimeLimit, IsNotToldWhereTheSearchWasCompleted) {
  Configuration configuration = test::example1Configuration();
  configuration.estimation.time_limit = 1000;
  const Estimate estimate = Identifier(configuration).identify(test::example1Experiments(20));
  EXPECT_EQ(estimate.termination, Termination::converged) << estimate.message;
}

}  // namespace
}  // namespace uncertainty_identification
