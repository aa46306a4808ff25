// Models on top of which causes are looked for where the orders were chosen from the data.
#include "explanation/order_candidates.h"

#include <gtest/gtest.h>

#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

/// Of twelve experiments of Example 1, whose plant is of order 1; of one where they are short.
int orderAskedFor(int samples, int order) {
  std::vector<Experiment> experiments = test::example1(2, 12).experiments;
  for (Experiment& experiment : experiments) {
    experiment.u.conservativeResize(samples);
    experiment.y.conservativeResize(samples);
  }
  Configuration configuration = test::example1Configuration();
  configuration.nominal_model.na = configuration.nominal_model.nb = order;
  if (samples < 50) {
    experiments.resize(1);
    configuration.error_model.taps = 0;
  }
  const Estimate estimate = Identifier(configuration).identify(experiments);
  configuration.nominal_model.orders_auto = true;
  WorkerPool pool(1);
  FitContext context;
  context.pool = &pool;
  context.going_on = [] { return true; };
  return orderCandidates(configuration, estimate, experiments, context, {})
      .front()
      .configuration.nominal_model.na;
}

TEST(OrderCandidates, LeavesThoseThatSuffice) { EXPECT_EQ(orderAskedFor(100, 1), 1); }

/// Two poles more would need 22 samples, and there are 20: none is taken, and nothing fails.
TEST(OrderCandidates, TriesNoMoreThanTheDataAllow) { EXPECT_EQ(orderAskedFor(20, 2), 2); }

}  // namespace
}  // namespace uncertainty_identification
