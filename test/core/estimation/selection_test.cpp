#include "estimation/selection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

TEST(MixtureParameters, AreTheFreeOnes) {
  EXPECT_EQ(mixtureParameters(Constraint::zero_static_gain, 0, 1), 0);
  EXPECT_EQ(mixtureParameters(Constraint::zero_static_gain, 1, 2), 1 + 2 + 2);
  EXPECT_EQ(mixtureParameters(Constraint::free, 3, 2), 1 + 6 + 12);
  EXPECT_EQ(mixtureParameters(Constraint::zero_mean, 3, 2), 1 + 3 + 12);
  EXPECT_EQ(mixtureParameters(Constraint::zero_mean, 2, 1), 3);
}

Candidate candidateOf(std::optional<double> bic) { return {"taps", "", 3, 0.0, bic, {}, false}; }

TEST(ChooseLeastBic, MarksTheFirstOfLeastBic) {
  std::vector<Candidate> candidates{candidateOf(1), candidateOf(5), candidateOf({}), candidateOf(4),
                                    candidateOf(4)};
  EXPECT_EQ(chooseLeastBic(1, &candidates), std::optional<std::size_t>(3));
  for (std::size_t k = 0; k < candidates.size(); ++k) EXPECT_EQ(candidates[k].chosen, k == 3) << k;
}

/// What is not a number or infinite is no reason to choose a candidate.
TEST(ChooseLeastBic, MarksNoneWhereNoBicIsFinite) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<Candidate> candidates{candidateOf(kInfinity), candidateOf(-kInfinity),
                                    candidateOf(std::nan("")), candidateOf({})};
  EXPECT_FALSE(chooseLeastBic(0, &candidates).has_value());
  for (const Candidate& candidate : candidates) EXPECT_FALSE(candidate.chosen);
}

class SelectOrders : public testing::Test {
 protected:
  SelectOrders() {
    options_.nb = options_.na = 2;
    options_.nc = options_.nd = options_.taps = 0;
    options_.delay = 3;
    options_.experiments = 9;
    options_.min_samples = options_.max_samples = 250;
    options_.noise_variance = 0.3;
    auto system = test::randomSystem(options_, 2);
    system.truth.b = test::vectorOf({0.5, 0.4});
    system.truth.a = test::vectorOf({-1.4, 0.65});
    system_ = test::simulateSystem(system.truth, options_, 3);
    configuration_ = test::configurationOf(options_);
    configuration_.nominal_model.orders_auto = true;
    configuration_.nominal_model.max_order = 4;
    configuration_.nominal_model.max_delay = 6;
  }

  NominalModelOptions select() {
    candidates_.clear();
    return selectOrders(configuration_, 1, system_.experiments, 1, &candidates_, {});
  }

  test::RandomSystemOptions options_;
  test::RandomSystem system_;
  Configuration configuration_;
  std::vector<Candidate> candidates_;
};

TEST_F(SelectOrders, FindsOrderTwoAndDelayThree) {
  const NominalModelOptions chosen = select();
  EXPECT_EQ(chosen.na, 2);
  EXPECT_EQ(chosen.nb, 2);
  EXPECT_EQ(chosen.delay, 3);
  EXPECT_GE(candidates_.size(), 4u);
  for (const Candidate& candidate : candidates_) {
    EXPECT_EQ(candidate.choice, "orders");
    EXPECT_FALSE(candidate.description.empty());
  }
}

TEST_F(SelectOrders, ByPredictionFindsThemToo) {
  configuration_.nominal_model.focus = Focus::prediction;
  const NominalModelOptions chosen = select();
  EXPECT_EQ(chosen.na, 2);
  EXPECT_EQ(chosen.delay, 3);
  EXPECT_EQ(chosen.structure, Structure::output_error);
  int marked = 0;
  double lowest = *candidates_[0].bic, of_marked = 0;
  for (const Candidate& candidate : candidates_) {
    marked += candidate.chosen ? 1 : 0;
    if (candidate.chosen) of_marked = *candidate.bic;
    lowest = std::min(lowest, *candidate.bic);
  }
  EXPECT_EQ(marked, 1);
  EXPECT_EQ(of_marked, lowest);
}

TEST_F(SelectOrders, ByPredictionFindsColouredNoise) {
  system_.truth.d = test::vectorOf({-0.9});
  options_.nd = 1;
  options_.noise_run_up = 100;
  system_ = test::simulateSystem(system_.truth, options_, 5);
  configuration_.nominal_model.focus = Focus::prediction;
  configuration_.estimation.noise_start = NoiseStart::stationary;
  const NominalModelOptions chosen = select();
  EXPECT_EQ(chosen.structure, Structure::box_jenkins);
  EXPECT_EQ(chosen.na, 2);
  EXPECT_EQ(chosen.nd, 1);
}

TEST_F(SelectOrders, StopsWhenAskedTo) {
  int calls = 0;
  selectOrders(configuration_, 1, system_.experiments, 1, &candidates_, [&](double share) {
    EXPECT_GE(share, 0);
    EXPECT_LE(share, 1);
    return ++calls < 2;
  });
  EXPECT_LE(candidates_.size(), 4u);
}

/// Slow noise in a single record favours one order or another by chance. With a tolerance of half a
/// point of fit, and no look at what the data can tell, order 1 is found in 33 of these 40.
TEST(SelectOrdersOfARecord, DoesNotTakeLuckForPoles) {
  int right = 0;
  for (int seed = 1; seed <= 40; ++seed) {
    test::RandomSystemOptions options;
    options.nb = options.na = options.nd = 1;
    options.nc = options.taps = options.delay = 0;
    options.experiments = 1;
    options.min_samples = options.max_samples = 300;
    options.noise_variance = 0.02;
    options.noise_run_up = 100;
    auto system = test::randomSystem(options, seed);
    system.truth.b = test::vectorOf({0.3});
    system.truth.a = test::vectorOf({-0.9});
    system.truth.d = test::vectorOf({-0.95});
    system = test::simulateSystem(system.truth, options, seed);
    Configuration configuration = test::configurationOf(options);
    configuration.nominal_model.orders_auto = true;
    configuration.nominal_model.max_delay = 6;
    std::vector<Candidate> candidates;
    right += selectOrders(configuration, 1, system.experiments, 1, &candidates, {}).na == 1;
  }
  EXPECT_GE(right, 36);
}

}  // namespace
}  // namespace uncertainty_identification
