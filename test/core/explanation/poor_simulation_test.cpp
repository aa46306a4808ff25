// "Nothing is wrong", of data that are too few to look for what the simulation lacks.
#include "explanation/poor_simulation.h"

#include <gtest/gtest.h>

#include "support/mentions.h"

namespace uncertainty_identification {
namespace {

/// An answer of "none", with a model that simulates a held-out experiment by this much, and its own
/// by 85 %.
Explanation answered(std::optional<double> held_out_fit) {
  Explanation explanation;
  explanation.verdict = Verdict::none;
  explanation.message = "the model agrees with the data";
  explanation.simulation.skipped = "fewer than 200 samples";
  explanation.before.simulation_fit_percent = 85;
  if (held_out_fit) explanation.held_out = {"1"};
  explanation.held_out_fit = held_out_fit;
  warnOfPoorSimulation(&explanation);
  return explanation;
}

TEST(PoorSimulation, NothingIsNotSaidWhereTheModelSimulatesHeldOutDataFarWorse) {
  const Explanation found = answered(61);  // 39 / 15 times the error
  EXPECT_EQ(found.verdict, Verdict::unknown);
  EXPECT_TRUE(test::mentions(found.message, "simulates held-out data by 61 % only, with 2.6 times"))
      << found.message;
  EXPECT_EQ(answered(70).verdict, Verdict::none);
}

TEST(PoorSimulation, TheModelIsAskedAlsoWhereALinearPlantSimulatesWindowsWell) {
  Explanation explanation = answered(95);
  explanation.simulation.skipped.clear();
  explanation.simulation.preparation = "2 records, simulated in 8 windows";
  explanation.simulation.fit_before = explanation.simulation.fit_after = 96;
  explanation.simulation.held_out_error_ratio = 1;
  explanation.held_out_fit = 20;
  warnOfPoorSimulation(&explanation);
  EXPECT_EQ(explanation.verdict, Verdict::unknown) << explanation.message;
}

TEST(PoorSimulation, NothingSaysThatTheTestsCannotSeeWhatAModelThatLeavesMostLacks) {
  const auto said = [](double held_out_fit, double linear = 57) {
    Explanation explanation = answered(95);
    explanation.message = "the model agrees with the data";
    explanation.before.simulation_fit_percent = 55;
    explanation.simulation.skipped.clear();
    explanation.simulation.preparation = "3 records, simulated in 9 windows";
    explanation.simulation.fit_before = explanation.simulation.fit_after = linear;
    explanation.held_out_fit = held_out_fit;
    warnOfPoorSimulation(&explanation);
    return explanation;
  };
  EXPECT_TRUE(test::mentions(said(32).message, "held-out data by 32 % only")) << said(32).message;
  EXPECT_EQ(said(32).verdict, Verdict::unknown);
  EXPECT_TRUE(test::mentions(said(52).message, "agrees with the data")) << said(52).message;
  EXPECT_EQ(said(52).verdict, Verdict::none);
  EXPECT_EQ(said(32, 35).verdict, Verdict::none) << "there may be much noise";
}

TEST(PoorSimulation, AModelMayBeBehindALinearPlantWithTheSameOffset) {
  SimulationCauses simulation;
  simulation.fit_before = 87;
  Estimate model;
  model.configuration.estimation.offsets = Offsets::estimate;
  EXPECT_TRUE(isBehindLinear(model, 70, simulation));
  EXPECT_FALSE(isBehindLinear(model, 80, simulation));
  simulation.lasting_oscillation = 3;
  EXPECT_FALSE(isBehindLinear(model, 70, simulation)) << "which holds a line that is no response";
  simulation.lasting_oscillation = 0;
  model.configuration.estimation.offsets = Offsets::per_experiment;
  EXPECT_FALSE(isBehindLinear(model, 70, simulation)) << "whose fit is about another mean";
}

TEST(PoorSimulation, AModelThatAConstantBeatsIsUnknownWithoutASearch) {
  Explanation explanation;
  explanation.verdict = Verdict::none;
  explanation.simulation.skipped = "fewer than 200 samples";
  explanation.before.simulation_fit_percent = -5;
  warnOfPoorSimulation(&explanation);
  EXPECT_EQ(explanation.verdict, Verdict::unknown) << explanation.message;
}

TEST(PoorSimulation, NothingIsSaidWithTheFitAndWithWhatWasNotLookedFor) {
  EXPECT_TRUE(test::mentions(answered(95).message, "Its simulation fits held-out data by 95 %"));
  const Explanation found = answered({});
  EXPECT_EQ(found.verdict, Verdict::none);
  EXPECT_TRUE(test::mentions(found.message,
                             "agrees with the data. Its simulation fits the data by "
                             "85 %; what it lacks was not looked for (fewer than"))
      << found.message;
}

TEST(PoorSimulation, NothingSaysWhatTheRestIsTakenFor) {
  const auto said = [](double fit) {
    Explanation explanation;
    explanation.verdict = Verdict::none;
    explanation.before.simulation_fit_percent = fit;
    warnOfPoorSimulation(&explanation);
    return explanation.message;
  };
  const std::string rest = "the rest, 20 % of the output's deviation, is taken for what the input";
  EXPECT_TRUE(test::mentions(said(80), rest)) << said(80);
  EXPECT_FALSE(test::mentions(said(91), "the rest")) << said(91);
  EXPECT_TRUE(
      test::mentions(restInWords(80, true), "the differences between experiments and what"));
}

TEST(PoorSimulation, NothingIsNotSaidOfFewDataByAModelThatIsNotTrusted) {
  Explanation explanation;
  explanation.verdict = Verdict::none;
  explanation.before.simulation_fit_percent = 85;
  explanation.before.trust = {false, {"a pole is at the edge; try explain, which looks"}};
  Explanation searched = explanation;
  warnOfPoorSimulation(&searched);
  EXPECT_EQ(searched.verdict, Verdict::none) << "of enough data";
  for (const char* skipped : {"fewer than 200 samples", "the input makes fewer than six steps"}) {
    Explanation little = explanation;
    little.simulation.skipped = skipped;
    warnOfPoorSimulation(&little);
    EXPECT_EQ(little.verdict, Verdict::unknown);
    EXPECT_TRUE(test::mentions(little.message, "relied on: a pole is at the edge. The sim"))
        << little.message;
  }
}

/// A fit of 99 % says that what is wrong is small.
TEST(PoorSimulation, WhatIsUnknownIsSaidWithTheFit) {
  Explanation explanation = answered(95);
  explanation.verdict = Verdict::unknown;
  explanation.message = "something is wrong";
  warnOfPoorSimulation(&explanation);
  EXPECT_TRUE(test::mentions(explanation.message,
                             "wrong. The simulation without a cause fits held-out data by 95 %"))
      << explanation.message;
}

}  // namespace
}  // namespace uncertainty_identification
