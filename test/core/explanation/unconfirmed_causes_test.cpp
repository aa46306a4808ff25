#include "explanation/unconfirmed_causes.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "explanation/simulation_answer.h"
#include "support/mentions.h"

namespace uncertainty_identification {
namespace {

/// Tests fail with a curve of the sensor and a spread, both of which simulate clearly better; the
/// simulation withheld a curve of these names.
Explanation withheld(const std::vector<std::string>& names) {
  Explanation found;
  found.checks_before = found.checks_after = {{"whiteness", 1, 1e-9, false, ""}};
  found.verdict = Verdict::partly_explained;
  for (const std::string name : {"sens_wiener", "plant_parameter_spread"}) {
    Cause cause;
    cause.name = name;
    cause.gain = Gain{};
    cause.gain->nrmse_fit_percent = {87, 90};
    found.causes.push_back(cause);
  }
  found.simulation.withheld = names;
  return found;
}

std::vector<std::string> left(Explanation found) {
  dropBesideWithheld(&found);
  std::vector<std::string> names;
  for (const Cause& cause : found.causes) names.push_back(cause.name);
  return names;
}

/// The outflow of a tank by the root of its level, which the likelihood lacks, looks to it like a
/// curve of the sensor.
TEST(UnconfirmedCauses, ACurveIsNotNamedWhereTheSimulationShowsAnother) {
  EXPECT_EQ(left(withheld({"plant_cubic"})), std::vector<std::string>{"plant_parameter_spread"});
  EXPECT_EQ(left(withheld({"plant_cubic", "sens_wiener"})).size(), 2u) << "a tie of it";
  EXPECT_EQ(left(withheld({})).size(), 2u);
  Explanation clipped = withheld({"plant_product"});
  clipped.causes[0].name = "sens_clip";
  clipped.causes[0].seen_in_samples = true;
  EXPECT_EQ(left(clipped).size(), 2u) << "the samples show a limit by themselves";
}

TEST(UnconfirmedCauses, OneThatIsDroppedIsToldWithWhatIsInItsPlace) {
  Explanation found = withheld({"plant_cubic"});
  found.causes.pop_back();
  dropBesideWithheld(&found);
  EXPECT_EQ(found.verdict, Verdict::unknown);
  ASSERT_EQ(found.warnings.size(), 1u);
  EXPECT_TRUE(test::mentions(found.warnings[0], "sens_wiener: found by the likelihood"));
  EXPECT_TRUE(test::mentions(found.warnings[0], "plant_cubic in its place"));
}

/// Tests of the noise alone say nothing against a curve of the plant.
TEST(UnconfirmedCauses, TheAnswerHasNoCurveBesideAWithheldOneUnlessOnlyTheNoiseIsWrong) {
  for (const std::string failing : {"whiteness", "tails"}) {
    Explanation found = withheld({"plant_cubic"});
    found.causes.pop_back();
    found.held_out = {"1"};
    found.checks_before[0].name = found.checks_after[0].name = failing;
    joinSimulation(&found, {});
    EXPECT_EQ(found.causes.size(), failing == "tails" ? 1u : 0u) << failing;
  }
}

/// Where something else is wrong, any curve takes part of it up.
TEST(UnconfirmedCauses, ACurveThatTheFreeSimulationDoesNotShowIsNotNamed) {
  for (const std::string name : {"act_hammerstein", "sens_drift", "plant_parameter_spread"}) {
    Explanation found = withheld({});
    found.causes.pop_back();
    found.held_out = {"1"};
    found.causes[0].name = name;
    joinSimulation(&found, {});
    const bool is_curve = name == "act_hammerstein";
    EXPECT_EQ(found.causes.size(), is_curve ? 0u : 1u) << name;
    EXPECT_EQ(test::anyMentions(found.warnings, "does not show it"), is_curve);
  }
  Explanation not_searched = withheld({});
  not_searched.held_out = {"1"};
  not_searched.simulation.skipped = "only one window";
  joinSimulation(&not_searched, {});
  EXPECT_EQ(not_searched.causes.size(), 2u);
}

/// A dead time that differs from run to run takes up what a controller that nobody recorded does.
TEST(UnconfirmedCauses, WhatMakesTheSimulationWorseIsNotNamedWhileThePlantIsWrong) {
  for (const std::string failing : {"whiteness", "tails"}) {
    Explanation found = withheld({});
    found.checks_after[0].name = failing;
    found.causes = {found.causes[1]};
    found.causes[0].name = "exp_clock";
    found.causes[0].group = "experiment";
    found.causes[0].gain->nrmse_fit_percent = {50.6, 49.8};
    found.causes[0].gain->lower_90 = 5;  // the log density gains all the same
    dropUnconfirmed(&found);
    EXPECT_EQ(found.causes.size(), failing == "tails" ? 1u : 0u) << failing;
  }
}

/// What is said of it as not confirmed does not contradict that it is named.
TEST(UnconfirmedCauses, OneThatIsFoundTwiceIsToldInOneSentence) {
  Explanation found = withheld({"sens_wiener"});
  found.causes.pop_back();
  found.held_out = {"1"};
  found.simulation.refused = "sens_wiener: not found in windows of 200. Not named";
  joinSimulation(&found, {});
  ASSERT_EQ(found.causes.size(), 1u);
  EXPECT_FALSE(test::anyMentions(found.warnings, "Not named"));
  EXPECT_TRUE(
      test::anyMentions(found.warnings, "windows of 200. sens_wiener is named all the same"));
}

}  // namespace
}  // namespace uncertainty_identification
