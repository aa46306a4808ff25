// Effects hidden in random systems, which explain() must name. scripts/benchmark_explanation does
// the same with hundreds of systems and counts how often they are named. An effect changes the
// output by 5 % of its variance.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/hidden_effects/hidden_effect.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {
namespace {

struct Found {
  Explanation explanation;
  std::vector<std::string> names;
};

/// Explains 20 experiments of 200 samples of the first random system that hides the effect.
Found explained(const std::string& name, const std::vector<std::string>& exclude = {},
                bool orders_auto = false) {
  test::HiddenEffectOptions options;
  options.base = {20, 200};
  test::HiddenEffect hidden = test::randomHiddenEffect({name}, options, 1);
  hidden.declared.explanation.exclude = exclude;
  hidden.declared.explanation.time_limit = 0;  // the answer must not depend on the machine
  if (orders_auto) hidden.declared.nominal_model = NominalModelOptions();
  const test::HiddenEffectData data = test::simulateHidden(hidden, options);
  Found found{explain(hidden.declared, data.training, data.held_out), {}};
  for (const Cause& cause : found.explanation.causes) {
    found.names.push_back(cause.name);
    found.names.insert(found.names.end(), cause.equivalent.begin(), cause.equivalent.end());
  }
  return found;
}

/// Explains the data set that scripts/benchmark_explanation draws from this seed.
///
/// The tests that use it are regression tests. Each seed is that of a benchmark run in which a
/// wrong cause, or none, was once named for a reason that the test's comment gives, and few data
/// sets show that reason. How often causes are found at all is a rate over hundreds of runs, which
/// only the benchmark counts.
Explanation explainedInBenchmark(const std::vector<std::string>& names, std::uint64_t seed,
                                 bool orders_auto = false) {
  const test::HiddenEffectOptions options;
  test::HiddenEffect hidden = test::randomHiddenEffect(names, options, seed);
  if (orders_auto) hidden.declared.nominal_model = NominalModelOptions();
  hidden.declared.explanation.time_limit = 0;  // the answer must not depend on the machine
  const test::HiddenEffectData data = test::simulateHidden(hidden, options);
  return explain(hidden.declared, data.training, data.held_out);
}

class HiddenEffects : public testing::TestWithParam<const char*> {};

TEST_P(HiddenEffects, AreNamed) {
  const Found found = explained(GetParam());
  EXPECT_TRUE(std::count(found.names.begin(), found.names.end(), GetParam()))
      << found.explanation.message;
}

// Where the catalogue lacks the drift, coloured noise absorbs most of it, and offsets and lags
// absorb some of the rest. None of these may be named as a cause. This is one system for which it
// holds; how often it does, scripts/benchmark_explanation --remove counts.
TEST(HiddenEffects, OutsideTheCatalogueAreUnknown) {
  const Found found = explained("sens_drift", {"sens_drift"});
  EXPECT_EQ(found.explanation.verdict, Verdict::unknown) << found.explanation.message;
  EXPECT_TRUE(found.names.empty()) << found.names.front();
  const auto& warnings = found.explanation.warnings;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
    return warning.find("(noise_colour) describes part of what is wrong") != std::string::npos;
  }));
}

// In run 2 of scripts/benchmark_explanation a resonance is accepted first, then the delay, and the
// resonance is eliminated. The gain must then be that of the delay over the model without both.
TEST(HiddenEffects, GainOverTheModelWithoutThem) {
  const Explanation explanation = explainedInBenchmark({"act_delay"}, 10026407891151178533U);
  ASSERT_EQ(explanation.causes.size(), 1U) << explanation.message;
  EXPECT_EQ(explanation.causes[0].name, "act_delay");
  const double before = explanation.before.noise_variance.value;
  EXPECT_NEAR(explanation.causes[0].gain->noise_variance.before, before, 0.01 * before);
  EXPECT_GT(explanation.causes[0].gain->log_density, 15);  // 3.5 beside the resonance
  EXPECT_EQ(explanation.candidates.front().name, "act_delay");
}

// In run 1 of scripts/benchmark_explanation the mixture has absorbed most of the spread. The true
// effect gains only if theta and the mixture are fitted from new starts; a clock was named instead.
TEST(HiddenEffects, AreNamedThoughTheMixtureHadTakenThemUp) {
  const Explanation explanation =
      explainedInBenchmark({"plant_parameter_spread"}, 7995359279314928241U);
  ASSERT_EQ(explanation.causes.size(), 1U) << explanation.message;
  EXPECT_EQ(explanation.causes[0].name, "plant_parameter_spread");
}

// In the first run of these pairs the free simulation shows the second input, and the likelihood
// tries only what its curves name. The noise that changes within each experiment is no curve.
TEST(HiddenEffects, AreNamedBesideACurve) {
  const Explanation explanation =
      explainedInBenchmark({"exp_input2", "noise_step"}, 7971646382547159552U);
  EXPECT_EQ(explanation.verdict, Verdict::explained) << explanation.message;
  ASSERT_EQ(explanation.causes.size(), 2U) << explanation.message;
  EXPECT_EQ(explanation.causes[0].name, "exp_input2");
  EXPECT_EQ(explanation.causes[1].name, "noise_step");
}

// In run 12 of scripts/benchmark_explanation the noise model has a pole and a zero at 1, where they
// describe the bias of each experiment, and the colour of the noise is left in the residuals.
TEST(HiddenEffects, AreNamedThoughTheDeclaredNoiseModelHoldsThem) {
  const Explanation explanation = explainedInBenchmark({"sens_bias"}, 14470121690041342542U);
  EXPECT_EQ(explanation.verdict, Verdict::explained) << explanation.message;
  ASSERT_EQ(explanation.causes.size(), 1U) << explanation.message;
  EXPECT_EQ(explanation.causes[0].name, "sens_bias");
}

// In run 8 of scripts/benchmark_explanation the declared noise pole has moved to where the missing
// pair of noise poles is. An optimisation from there does not find all three.
TEST(HiddenEffects, AreNamedThoughTheDeclaredNoisePoleTookTheirPlace) {
  const Explanation explanation = explainedInBenchmark({"noise_colour"}, 15283938968436521478U);
  EXPECT_EQ(explanation.verdict, Verdict::explained) << explanation.message;
  ASSERT_EQ(explanation.causes.size(), 1U) << explanation.message;
  EXPECT_EQ(explanation.causes[0].name, "noise_colour");
}

// In run 24 of scripts/benchmark_explanation a time constant varies by 28 % between experiments
// while the gain is constant: pole and numerator vary together.
TEST(HiddenEffects, OfTimeConstantsAreNamedAndMeasured) {
  const Explanation explanation =
      explainedInBenchmark({"plant_parameter_spread"}, 11957383091814770772U);
  EXPECT_EQ(explanation.verdict, Verdict::explained) << explanation.message;
  ASSERT_EQ(explanation.causes.size(), 1U) << explanation.message;
  EXPECT_EQ(explanation.causes[0].name, "plant_parameter_spread");
  EXPECT_EQ(explanation.causes[0].variant, "time_constant");
  const CauseParameter& deviation = explanation.causes[0].parameters.at(0);
  EXPECT_NEAR(deviation.value, 0.28125, 3 * deviation.standard_error);
  EXPECT_LT(deviation.standard_error, 0.05);
}

// Held-out experiments lie in time between those fitted to. Their start times say where, so the
// aging is interpolated.
TEST(HiddenEffects, OfAgingGainOnTheExperimentsBetween) {
  const Explanation explanation = explainedInBenchmark({"plant_aging"}, 8590386309758793518U);
  ASSERT_EQ(explanation.causes.size(), 1U) << explanation.message;
  EXPECT_EQ(explanation.causes[0].name, "plant_aging");
  EXPECT_GT(explanation.causes[0].gain->lower_90, 0);
}

// In clean run 12 of scripts/benchmark_explanation the order chosen by the error of simulations is
// too low. The missing dynamics must not be named as a delay.
TEST(HiddenEffects, AreNotMadeOfOrdersThatWereChosenTooLow) {
  const Explanation explanation = explainedInBenchmark({}, 9720260655492891654U, true);
  EXPECT_EQ(explanation.verdict, Verdict::none) << explanation.message;
  const auto& warnings = explanation.warnings;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
    return warning.find("the likelihood of all experiments asks for nb=") != std::string::npos;
  }));
}

// Where the orders are free, a model with one more pole, and one without it but with the pole as a
// cause, often explain the data equally well. Then no cause is named, but a warning says so: in 4
// of these 6 runs.
TEST(HiddenEffects, ThatALargerModelHoldsAsWellAreATieAndToldAsOne) {
  int ties = 0;
  for (std::uint64_t seed = 12; seed <= 17; ++seed) {
    const Explanation explanation = explainedInBenchmark({"plant_pole"}, seed, true);
    const auto& warnings = explanation.warnings;
    const bool tie = std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
      return warning.find("(plant_pole) would explain the data as well") != std::string::npos;
    });
    EXPECT_TRUE(!tie || explanation.causes.empty()) << explanation.message;
    ties += tie;
  }
  EXPECT_GE(ties, 2);
}

// A chosen noise model with poles on the unit circle describes a hum, and one with a pole at 1 a
// bias.
TEST(HiddenEffects, AreNamedThoughAChosenNoiseModelHoldsThem) {
  for (const char* name : {"sens_hum", "sens_bias"}) {
    const Found found = explained(name, {}, true);
    EXPECT_TRUE(std::count(found.names.begin(), found.names.end(), name))
        << found.explanation.message;
  }
}

INSTANTIATE_TEST_SUITE_P(OfEachStage, HiddenEffects,
                         testing::Values("act_deadzone", "act_hammerstein", "plant_drift",
                                         "plant_cubic", "sens_bias", "sens_hum", "sens_outliers",
                                         "noise_colour"));

}  // namespace
}  // namespace uncertainty_identification
