#include "io/explanation_text.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/example_explanation.h"

namespace uncertainty_identification {
namespace {

using test::exampleExplanation;

void expectPartOfText(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "no " << part << " in\n" << text;
}

TEST(ExplanationText, BeginsWithTheVerdict) {
  EXPECT_EQ(explanationText(exampleExplanation())
                .rfind("Verdict: partly_explained: the actuator has a dead zone", 0),
            0u);
}

TEST(ExplanationText, ShowsTestsThatFailFirstAndWhatBecomesOfThem) {
  expectPartOfText(
      explanationText(exampleExplanation()),
      "  Test of the residuals  without the causes                        with them\n"
      "  whiteness              FAILS, p < 1e-16, 0.5 to 2 rad/s          FAILS, p = 3e-09, "
      "8 to 9 rad/s\n"
      "  kurtosis               FAILS, p = 1e-08, experiments run3, run7  passes\n"
      "  variance over time     passes                                    passes\n");
}

TEST(ExplanationText, ShowsCausesWithParametersAndGain) {
  const std::string text = explanationText(exampleExplanation());
  expectPartOfText(
      text,
      "\nCause 1: act_deadzone, actuator, the best of the catalogue; tests still fail, "
      "so it has no probability\n");
  expectPartOfText(text, "  inputs smaller than the width have no effect\n");
  expectPartOfText(text, "  or act_backlash, which explains the data equally well\n");
  expectPartOfText(text, "  width [V]  0.3100 +- 0.0040  90 %: 0.303 to 0.317\n");
  expectPartOfText(text, "  ratio      1                 90 %: -\n");
  expectPartOfText(text, "  On 2 experiments not used for fitting:\n");
  expectPartOfText(text, "gain per experiment [nats]     12.25 +- 0.33  90 %: 11.5 to 13\n");
  expectPartOfText(text, "simulation fit [%]             81.2 -> 88.9\n");
  expectPartOfText(text, "samples in 95 % intervals [%]  91 -> 95\n");
  expectPartOfText(text, "noise variance                 0.13 -> 0.1\n");
  expectPartOfText(text, "  What to do: move the actuator slowly through zero\n");
}

TEST(ExplanationText, GivesAProbabilityWhereNothingIsLeftWrong) {
  Explanation explained = exampleExplanation();
  explained.verdict = Verdict::explained;
  expectPartOfText(explanationText(explained),
                   "\nCause 1: act_deadzone, actuator, probability 98 %\n");
}

TEST(ExplanationText, GivesNoProbabilityWhereNotAllCausesWereTried) {
  Explanation explained = exampleExplanation();
  explained.verdict = Verdict::explained;
  explained.causes[0].confidence = std::numeric_limits<double>::quiet_NaN();
  explained.causes[0].simulation.reset();
  expectPartOfText(
      explanationText(explained),
      "\nCause 1: act_deadzone, actuator, no probability, since not all causes were tried\n");
}

TEST(ExplanationText, ShowsPlaceTiesAndCurveOfWhatTheSimulationShows) {
  Explanation example = test::exampleExplanation();
  example.causes[0].confidence = std::numeric_limits<double>::quiet_NaN();
  const std::string text = explanationText(example);
  for (const char* part :
       {"Cause 1: act_deadzone, actuator, found in the free simulation", "input: dead_zone",
        "81 -> 89.5", "play (act_backlash)", "curve at input -1", "-0.69, 90 %: -0.7 to -0.68",
        "What to do: move the actuator slowly"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " is missing in\n" << text;
  // The likelihood knows nothing of it: there are no nats to show.
  EXPECT_EQ(text.find("gain per experiment [nats]"), std::string::npos) << text;
}

TEST(ExplanationText, SaysWhatHasNoGain) {
  const std::string text = explanationText(exampleExplanation());
  const std::string second = text.substr(text.find("Cause 2: exp_feedback"));
  expectPartOfText(second, "It does not change predictions, so there is no gain.\n");
  EXPECT_EQ(second.find("not used for fitting"), std::string::npos);
}

TEST(ExplanationText, ShowsWhatWasTriedBestFirst) {
  expectPartOfText(explanationText(exampleExplanation()),
                   "  act_deadzone                  412.5         12.25 +- 0.33\n"
                   "  plant_temp (temp)             -3            -\n");
}

TEST(ExplanationText, WhereNothingIsWrongThereIsLittleToRead) {
  Explanation none = exampleExplanation();
  none.verdict = Verdict::none;
  none.message = "the simulation explains all there is";
  none.causes.clear();
  for (Check& check : none.checks_before) check.passed = true;
  EXPECT_EQ(explanationText(none),
            "Verdict: none: the simulation explains all there is\n\n"
            "All 3 tests of the residuals pass.\n\n"
            "Warning: only 12 experiments were kept out of the fit\n");
}

TEST(ExplanationText, WithoutACauseThereIsNothingToCompareWith) {
  Explanation unknown = exampleExplanation();
  unknown.verdict = Verdict::unknown;
  unknown.causes.clear();
  const std::string text = explanationText(unknown);
  expectPartOfText(text, "  whiteness              FAILS, p < 1e-16, 0.5 to 2 rad/s\n");
  expectPartOfText(text, "Best effects that were tried");
  EXPECT_EQ(text.find("with them"), std::string::npos);
}

}  // namespace
}  // namespace uncertainty_identification
