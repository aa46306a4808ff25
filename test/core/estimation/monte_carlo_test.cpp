// Short forms of the Monte Carlo studies that scripts/reproduce_table1 and
// scripts/calibrate_standard_errors run in full.
#include "support/monte_carlo.h"

#include <gtest/gtest.h>

#include <cmath>

namespace uncertainty_identification::test {
namespace {

/// The runs are shared: each takes a noticeable part of a second.
const std::vector<MonteCarloRun>& runs() {
  static const std::vector<MonteCarloRun> all = [] {
    std::vector<MonteCarloRun> made;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) made.push_back(example1Run(seed));
    return made;
  }();
  return all;
}

TEST(MonteCarlo, automaticStartReachesTheOptimumOfTheTruth) {
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(runs()[k].estimate.termination, Termination::converged) << "seed " << k + 1;
    EXPECT_GE(runs()[k].estimate.log_likelihood, runs()[k].from_truth - 1e-4) << "seed " << k + 1;
  }
}

TEST(MonteCarlo, meansLieWithinThreeStandardErrorsOfTheTruth) {
  for (const TableParameter& parameter : tableParameters(runs())) {
    const double error = parameter.deviation() / std::sqrt(static_cast<double>(runs().size()));
    EXPECT_NEAR(parameter.mean(), parameter.truth, 3 * error) << parameter.name;
  }
}

// Exact 95 % intervals: fewer than 88 of 100 hold the truth with probability 0.15 %, all 100 with
// 0.6 % (binomial tails).
TEST(MonteCarlo, intervalsOf95PercentCoverAsOftenAsTheyShould) {
  for (const TableParameter& parameter : tableParameters(runs())) {
    for (const auto* errors : {&parameter.errors, &parameter.robust_errors}) {
      const double coverage = parameter.coverage(*errors);
      EXPECT_GE(coverage, 0.88) << parameter.name;
      EXPECT_LT(coverage, 1.0) << parameter.name;
    }
  }
}

}  // namespace
}  // namespace uncertainty_identification::test
