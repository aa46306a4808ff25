// Effects hidden in random systems, and found: a few of those that scripts/benchmark_explanation
// counts by the hundred. 5 % of the output's variance, the seed being the run's number, 1.
#include <gtest/gtest.h>

#include <algorithm>

#include "simulation/hidden_effect.h"
#include "support/hidden_effects/hidden_effect.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {
namespace {

struct Found {
  Explanation explanation;
  std::vector<std::string> names;
};

/// What is found in 20 experiments of 200 samples, run 1.
Found explained(const std::string& name, const std::vector<std::string>& exclude = {},
                bool orders_auto = false) {
  test::HiddenEffectOptions options;
  options.base = {20, 200};
  test::HiddenEffect hidden = test::randomHiddenEffect({name}, options, 1);
  hidden.declared.explanation.exclude = exclude;
  hidden.declared.nominal_model.orders_auto = orders_auto;
  const test::HiddenEffectData data = test::simulateHidden(hidden, options);
  Found found{explain(hidden.declared, data.training, data.held_out), {}};
  for (const Cause& cause : found.explanation.causes) {
    found.names.push_back(cause.name);
    found.names.insert(found.names.end(), cause.equivalent.begin(), cause.equivalent.end());
  }
  return found;
}

/// What scripts/benchmark_explanation's data set of this seed is explained by.
Explanation explainedInBenchmark(const std::vector<std::string>& names, std::uint64_t seed,
                                 bool orders_auto = false) {
  const test::HiddenEffectOptions options;
  test::HiddenEffect hidden = test::randomHiddenEffect(names, options, seed);
  hidden.declared.nominal_model.orders_auto = orders_auto;
  const test::HiddenEffectData data = test::simulateHidden(hidden, options);
  return explain(hidden.declared, data.training, data.held_out);
}

class HiddenEffects : public testing::TestWithParam<const char*> {};

TEST_P(HiddenEffects, AreNamed) {
  const Found found = explained(GetParam());
  EXPECT_TRUE(std::count(found.names.begin(), found.names.end(), GetParam()))
      << found.explanation.message;
}

// One of those for which it holds; how often it does, scripts/benchmark_explanation --remove
// counts. A drift stays where the catalogue lacks it: coloured noise takes in most of it, and the
// offsets and lags found beside that must not be passed off as causes.
TEST(HiddenEffects, OutsideTheCatalogueAreUnknown) {
  const Found found = explained("sens_drift", {"sens_drift"});
  EXPECT_EQ(found.explanation.verdict, Verdict::unknown) << found.explanation.message;
  EXPECT_TRUE(found.names.empty()) << found.names.front();
  const auto& warnings = found.explanation.warnings;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
    return warning.rfind("noise_colour describes part of what is wrong", 0) == 0;
  }));
}

// In scripts/benchmark_explanation's run 2 a resonance is taken in first, the delay on top of it,
// and the resonance out again.
TEST(HiddenEffects, GainOverTheModelWithoutThem) {
  const Explanation explanation = explainedInBenchmark({"act_delay"}, 10026407891151178533U);
  ASSERT_EQ(explanation.causes.size(), 1U) << explanation.message;
  EXPECT_EQ(explanation.causes[0].name, "act_delay");
  const double before = explanation.before.noise_variance.value;
  EXPECT_NEAR(explanation.causes[0].gain->noise_variance.before, before, 0.01 * before);
  EXPECT_GT(explanation.causes[0].gain->log_density, 15);  // 3.5 beside the resonance
  EXPECT_EQ(explanation.candidates.front().name, "act_delay");
}

// In scripts/benchmark_explanation's run 1 the mixture has taken up most of the spread: its
// candidate gains only where theta and mixture start anew, and a clock was named instead.
TEST(HiddenEffects, AreNamedThoughTheMixtureHadTakenThemUp) {
  const Explanation explanation =
      explainedInBenchmark({"plant_parameter_spread"}, 7995359279314928241U);
  ASSERT_EQ(explanation.causes.size(), 1U) << explanation.message;
  EXPECT_EQ(explanation.causes[0].name, "plant_parameter_spread");
}

// In scripts/benchmark_explanation's run 12 the noise model has put pole and zero at 1, where they
// hold the bias of each experiment, and left the noise's colour in the residuals.
TEST(HiddenEffects, AreNamedThoughTheDeclaredNoiseModelHoldsThem) {
  const Explanation explanation = explainedInBenchmark({"sens_bias"}, 14470121690041342542U);
  EXPECT_EQ(explanation.verdict, Verdict::explained) << explanation.message;
  ASSERT_EQ(explanation.causes.size(), 1U) << explanation.message;
  EXPECT_EQ(explanation.causes[0].name, "sens_bias");
}

// In scripts/benchmark_explanation's run 8 the declared noise pole has taken the place of a pair
// that is missing, from where no optimisation finds all three.
TEST(HiddenEffects, AreNamedThoughTheDeclaredNoisePoleTookTheirPlace) {
  const Explanation explanation = explainedInBenchmark({"noise_colour"}, 15283938968436521478U);
  EXPECT_EQ(explanation.verdict, Verdict::explained) << explanation.message;
  ASSERT_EQ(explanation.causes.size(), 1U) << explanation.message;
  EXPECT_EQ(explanation.causes[0].name, "noise_colour");
}

// In scripts/benchmark_explanation's run 24 a time constant varies by 28 %, gain and error model
// staying: pole and numerator vary together.
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

// Experiments held out lie between those fitted to: where, their beginnings tell.
TEST(HiddenEffects, OfAgingGainOnTheExperimentsBetween) {
  const Explanation explanation = explainedInBenchmark({"plant_aging"}, 8590386309758793518U);
  ASSERT_EQ(explanation.causes.size(), 1U) << explanation.message;
  EXPECT_EQ(explanation.causes[0].name, "plant_aging");
  EXPECT_GT(explanation.causes[0].gain->lower_90, 0);
}

// In scripts/benchmark_explanation's clean run 12 the order chosen by simulations is too low: what
// that lacks must not be named as a delay.
TEST(HiddenEffects, AreNotMadeOfOrdersThatWereChosenTooLow) {
  const Explanation explanation = explainedInBenchmark({}, 9720260655492891654U, true);
  EXPECT_EQ(explanation.verdict, Verdict::none) << explanation.message;
  const auto& warnings = explanation.warnings;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
    return warning.find("the likelihood of all experiments asks for nb=") != std::string::npos;
  }));
}

// In scripts/benchmark_explanation's run 1 a model with a pole more and one without, the pole among
// the causes, explain the data equally well: a tie names nothing, but is told.
TEST(HiddenEffects, ThatALargerModelHoldsAsWellAreATieAndToldAsOne) {
  const Explanation explanation = explainedInBenchmark({"plant_pole"}, 2946816483728582142U, true);
  EXPECT_TRUE(explanation.causes.empty()) << explanation.message;
  const auto& warnings = explanation.warnings;
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
    return warning.find("plant_pole would explain the data as well") != std::string::npos;
  }));
}

// A noise model with poles on the unit circle holds a hum, and one at 1 a bias.
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
