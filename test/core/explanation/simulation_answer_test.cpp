#include "explanation/simulation_answer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/mentions.h"

namespace uncertainty_identification {
namespace {

Check checkThat(bool passed) { return {"whiteness", 1, passed ? 0.5 : 1e-9, passed, ""}; }

Cause ofLikelihood(const std::string& name, double before, double after) {
  Cause cause;
  cause.name = name;
  cause.confidence = 0.99;
  cause.gain = Gain{};
  cause.gain->nrmse_fit_percent = {before, after};
  cause.gain->coverage_95 = {0.95, 0.95};
  return cause;
}

/// The simulation shows friction, by which its fit rises from 90 to 98 %.
Explanation withFriction(bool passes, std::vector<Cause> causes) {
  Explanation explanation;
  explanation.checks_before = {checkThat(false)};
  explanation.checks_after = {checkThat(passes)};
  explanation.verdict = passes ? Verdict::explained : Verdict::partly_explained;
  explanation.causes = std::move(causes);
  explanation.held_out = {"12"};
  explanation.simulation.preparation = "1 record";
  explanation.simulation.fit_before = 90;
  explanation.simulation.fit_after = 98;
  SimulationCause friction;
  friction.what = {"plant_coulomb", "rate", "coulomb", ""};
  friction.description = "Coulomb friction";
  friction.values = {{"amplitude", 2, 0.1}};
  friction.ties = {{"act_backlash", "play", "play", ""}};
  friction.fit_before = 90;
  friction.fit_after = 98;
  explanation.simulation.causes = {friction};
  return explanation;
}

TEST(SimulationAnswer, ReplacesCausesWithWhichTestsStillFail) {
  Explanation found =
      withFriction(false, {ofLikelihood("sens_hum", 90, 89), ofLikelihood("exp_feedback", 0, 0)});
  joinSimulation(&found, {});
  ASSERT_EQ(found.causes.size(), 2u);
  const Cause& friction = found.causes[0];
  EXPECT_EQ(friction.name, "plant_coulomb");
  EXPECT_EQ(friction.group, "plant");
  EXPECT_TRUE(std::isnan(friction.confidence));
  EXPECT_EQ(friction.equivalent, std::vector<std::string>{"act_backlash"});
  ASSERT_TRUE(friction.gain);
  EXPECT_EQ(friction.gain->nrmse_fit_percent.after, 98);
  EXPECT_TRUE(std::isnan(friction.gain->log_density));
  ASSERT_EQ(friction.parameters.size(), 1u);
  EXPECT_NEAR(friction.parameters[0].upper_90, 2.1645, 1e-4);
  EXPECT_EQ(found.causes[1].name, "exp_feedback");  // seen by a test of the input
  EXPECT_EQ(found.verdict, Verdict::partly_explained);
  EXPECT_TRUE(test::mentions(found.message, "from 90 to 98 %")) << found.message;
  ASSERT_EQ(found.warnings.size(), 1u);
  EXPECT_TRUE(test::mentions(found.warnings[0], "sens_hum: found by the likelihood"));
}

TEST(SimulationAnswer, LeavesCausesWithWhichTestsPassAndTheSimulationGains) {
  Explanation found = withFriction(true, {ofLikelihood("plant_coulomb", 90, 97)});
  joinSimulation(&found, {});
  ASSERT_EQ(found.causes.size(), 1u);
  EXPECT_EQ(found.causes[0].confidence, 0.99);
  ASSERT_TRUE(found.causes[0].simulation);
  EXPECT_EQ(found.causes[0].simulation->what.shape, "coulomb");
  EXPECT_EQ(found.verdict, Verdict::explained);
}

TEST(SimulationAnswer, WarnsWhereTestsPassThoughTheSimulationIsPoor) {
  const auto warnings = [](double fit) {
    Explanation found = withFriction(true, {ofLikelihood("noise_tails", fit, fit)});
    found.simulation.causes.clear();
    joinSimulation(&found, {});
    return found.warnings;
  };
  ASSERT_EQ(warnings(9.8).size(), 1u);
  EXPECT_TRUE(test::mentions(warnings(9.8)[0], "fits held-out data by 9.8 % only"));
  EXPECT_TRUE(warnings(85).empty());
}

TEST(SimulationAnswer, DropsCurvesWithWhichTheModelSimulatesWorseThanALinearPlant) {
  for (const double fit : {70, 88}) {  // a linear plant: 90
    Explanation found = withFriction(true, {ofLikelihood("plant_coulomb", 0, fit)});
    found.simulation.causes.clear();
    joinSimulation(&found, {});
    EXPECT_EQ(found.verdict, fit < 85 ? Verdict::unknown : Verdict::explained) << fit;
  }
}

TEST(SimulationAnswer, IsNoExplanationWhereTheInputExplainsLittle) {
  const auto answered = [](double fit) {
    Explanation found = withFriction(true, {ofLikelihood("sens_quant", fit, fit)});
    found.simulation.causes.clear();
    joinSimulation(&found, {});
    return found;
  };
  EXPECT_EQ(answered(85).verdict, Verdict::explained);
  const Explanation poor = answered(22);
  EXPECT_EQ(poor.verdict, Verdict::partly_explained);
  EXPECT_TRUE(test::mentions(poor.message, "is there, but explains only a part: the simulation"))
      << poor.message;
}

TEST(SimulationAnswer, IsNoExplanationWhereIntervalsHoldFewSamples) {
  const auto answered = [](double coverage) {
    Explanation found = withFriction(true, {ofLikelihood("sens_quant", 87, 87)});
    found.causes[0].gain->coverage_95.after = coverage;
    found.simulation.causes.clear();
    joinSimulation(&found, {});
    return found;
  };
  EXPECT_EQ(answered(0.9).verdict, Verdict::explained);
  const Explanation narrow = answered(0.04);
  EXPECT_EQ(narrow.verdict, Verdict::partly_explained);
  EXPECT_TRUE(test::mentions(narrow.message, "hold 4 % of the samples only")) << narrow.message;
}

TEST(SimulationAnswer, IsUnknownWhereAConstantSimulatesBetter) {
  const auto answered = [](double fit) {
    Explanation found = withFriction(true, {});
    found.verdict = Verdict::none;
    found.simulation.causes.clear();
    found.simulation.fit_before = found.simulation.fit_after = fit;
    joinSimulation(&found, {});
    return found;
  };
  EXPECT_EQ(answered(80).verdict, Verdict::none);
  EXPECT_EQ(answered(30).verdict, Verdict::none) << "there may be much noise";
  EXPECT_TRUE(test::mentions(answered(30).message, "nothing wrong, but the simulation fits"));
  EXPECT_EQ(answered(-30).verdict, Verdict::unknown);
  EXPECT_TRUE(test::mentions(answered(-30).message, "by -30 % only"));
}

TEST(SimulationAnswer, TellsThatNoiseChangesNoSimulation) {
  const auto message = [](const std::string& name, const std::string& group) {
    Explanation found = withFriction(true, {ofLikelihood(name, 74, 74)});
    found.causes[0].group = group;
    found.simulation = {};
    joinSimulation(&found, {});
    return found.message;
  };
  const std::string told = "The simulation is the same with it and fits held-out data by 74 %";
  EXPECT_TRUE(test::mentions(message("noise_tails", "noise"), told));
  EXPECT_FALSE(test::mentions(message("act_delay", "actuator"), told));
  Explanation unknown_fit = withFriction(true, {ofLikelihood("noise_tails", NAN, NAN)});
  unknown_fit.causes[0].group = "noise";
  unknown_fit.simulation = {};
  unknown_fit.simulation.skipped = "the input is constant";
  joinSimulation(&unknown_fit, {});
  EXPECT_FALSE(test::mentions(unknown_fit.message, "nan")) << unknown_fit.message;
}

/// Also where the data were too few to search the simulation.
TEST(SimulationAnswer, NoiseExplainsNoSimulationThatFitsByLessThanHalf) {
  for (const char* skipped : {"", "fewer than 4 windows"}) {
    const auto answered = [skipped](double fit) {
      Explanation found = withFriction(true, {ofLikelihood("noise_step", fit, fit)});
      found.causes[0].group = "noise";
      found.simulation = {};
      found.simulation.skipped = skipped;
      joinSimulation(&found, {});
      return found;
    };
    EXPECT_EQ(answered(26).verdict, Verdict::unknown) << skipped;
    EXPECT_TRUE(test::mentions(answered(26).warnings.at(0), "noise_step: not named, because"));
    EXPECT_EQ(answered(60).verdict, Verdict::explained) << skipped;
  }
}

TEST(SimulationAnswer, TooFewSamplesToSearchItNeedCausesThatMakeItBetter) {
  const auto answered = [](const std::string& group, double after, bool is_held_out = true) {
    Explanation found = withFriction(true, {ofLikelihood("sens_drift", 84, after)});
    found.causes[0].group = group;
    found.simulation = {};
    found.simulation.skipped = "fewer than 200 samples";
    if (!is_held_out) found.held_out.clear();
    joinSimulation(&found, {});
    return found;
  };
  const Explanation dropped = answered("sensor", 84.1);
  EXPECT_TRUE(dropped.causes.empty());
  ASSERT_EQ(dropped.warnings.size(), 1u);
  EXPECT_TRUE(test::mentions(dropped.warnings[0], "sens_drift: makes the residuals white, but"));
  EXPECT_EQ(answered("sensor", 90).causes.size(), 1u);
  EXPECT_TRUE(answered("sensor", 87).causes.empty()) << "a curve has to halve the error";
  const Explanation in_sample = answered("sensor", 90, false);
  EXPECT_TRUE(in_sample.causes.empty());
  EXPECT_EQ(in_sample.verdict, Verdict::unknown);
  EXPECT_TRUE(test::mentions(in_sample.warnings.at(0), "no experiment is held out"));
  EXPECT_EQ(answered("noise", 84).causes.size(), 1u) << "changes no simulation";
}

TEST(SimulationAnswer, IsNoExplanationWhereAnotherLinearModelSimulatesFarBetter) {
  const auto verdict = [](const std::string& group, double fit) {
    Explanation found = withFriction(true, {ofLikelihood("noise_tails", fit, fit)});
    found.causes[0].group = group;
    found.simulation.causes.clear();  // its linear model fits by 90 %
    joinSimulation(&found, {});
    return found.verdict;
  };
  EXPECT_EQ(verdict("noise", 88), Verdict::explained);
  EXPECT_EQ(verdict("noise", 70), Verdict::unknown);
  EXPECT_EQ(verdict("plant", 70), Verdict::explained) << "warned of only";
}

/// In the data that the model was fitted to, every parameter gains.
TEST(SimulationAnswer, WithoutHeldOutDataTheSimulationOfLeftOutWindowsMustShowTheCause) {
  const auto answered = [](const std::string& name, const std::string& group) {
    Explanation found = withFriction(true, {ofLikelihood(name, 90, 98)});
    found.causes[0].group = group;
    found.held_out.clear();
    joinSimulation(&found, {});
    return found;
  };
  const Explanation unseen = answered("act_hammerstein", "actuator");
  EXPECT_TRUE(test::mentions(unseen.warnings.at(0), "give another record by --validation"));
  ASSERT_EQ(unseen.causes.size(), 1u) << "what it shows instead";
  EXPECT_EQ(unseen.causes[0].name, "plant_coulomb");
  EXPECT_EQ(unseen.verdict, Verdict::partly_explained);
  EXPECT_EQ(answered("plant_coulomb", "plant").causes.size(), 1u) << "the simulation shows it";
  EXPECT_EQ(answered("noise_step", "noise").causes.size(), 1u) << "changes no simulation";
  EXPECT_EQ(answered("sens_hum", "sensor").causes.at(0).name, "sens_hum")
      << "no curve, and takes most of the error away";
  EXPECT_EQ(answered("act_offset", "actuator").causes.at(0).name, "plant_coulomb")
      << "a constant only guesses the states better that records begin from";
}

/// A model that the likelihood has driven far from the data is mended by any offset.
TEST(SimulationAnswer, ACauseThatNothingConfirmsHasToSimulateAsALinearPlantDoes) {
  const auto answered = [](double without_causes) {
    Explanation found = withFriction(true, {ofLikelihood("sens_hum", -1541, 80)});
    found.causes[0].group = "sensor";
    found.held_out.clear();
    found.before.simulation_fit_percent = without_causes;
    found.simulation = {};
    found.simulation.skipped = "the input makes fewer than six steps";
    joinSimulation(&found, {});
    return found;
  };
  EXPECT_EQ(answered(75).causes.size(), 1u);
  EXPECT_TRUE(answered(93).causes.empty());
  EXPECT_TRUE(test::mentions(answered(93).warnings.at(0), "the identified one without it by 93 %"));
}

TEST(SimulationAnswer, NoiseBesideWhatIsNotConfirmedHidesNoCurve) {
  Explanation found = withFriction(
      true, {ofLikelihood("act_hammerstein", 90, 98), ofLikelihood("noise_step", 90, 90)});
  found.causes[0].group = "actuator";
  found.causes[1].group = "noise";
  found.held_out.clear();
  joinSimulation(&found, {});
  ASSERT_EQ(found.causes.size(), 1u);
  EXPECT_EQ(found.causes[0].name, "plant_coulomb");
}

/// A ramp is followed by a lag as well as by a curve; steps are not.
TEST(SimulationAnswer, NothingIsNotSaidWhereHeldOutDataAreSimulatedFarWorse) {
  const auto answered = [](double fit, double error_ratio) {
    Explanation found = withFriction(true, {});
    found.verdict = Verdict::none;
    found.simulation.causes.clear();
    found.simulation.fit_before = found.simulation.fit_after = fit;
    found.simulation.held_out_error_ratio = error_ratio;
    joinSimulation(&found, {});
    return found;
  };
  const Explanation lost = answered(69, 4);
  EXPECT_EQ(lost.verdict, Verdict::unknown);
  EXPECT_TRUE(test::mentions(lost.message, "held-out data by 69 % only, with 4 times the error"));
  EXPECT_EQ(answered(69, 2).verdict, Verdict::none);
  EXPECT_EQ(answered(95, 4).verdict, Verdict::none);
  Explanation of_one_record = withFriction(true, {});
  of_one_record.verdict = Verdict::none;
  of_one_record.held_out.clear();
  of_one_record.simulation.causes.clear();
  of_one_record.simulation.fit_before = of_one_record.simulation.fit_after = 69;
  of_one_record.simulation.held_out_error_ratio = 4;
  joinSimulation(&of_one_record, {});
  EXPECT_EQ(of_one_record.verdict, Verdict::none) << "its last third is no other record";
}

/// Where each record has an input of another size, a curve of the input looks like plants that
/// differ.
TEST(SimulationAnswer, FewPlantsThatDifferAreNotExplainedByTheSensor) {
  const auto answered = [](int experiments, double with_one_plant) {
    Explanation found = withFriction(true, {ofLikelihood("sens_quant", 99, 99)});
    found.before.experiment_count = experiments;
    found.simulation.causes.clear();
    found.simulation.fit_before = found.simulation.fit_after = with_one_plant;
    joinSimulation(&found, {});
    return found;
  };
  const Explanation few = answered(4, 65);
  EXPECT_EQ(few.verdict, Verdict::partly_explained);
  EXPECT_TRUE(test::mentions(few.message, "so few experiments do not show whether")) << few.message;
  EXPECT_EQ(answered(20, 65).verdict, Verdict::explained);
  EXPECT_EQ(answered(4, 95).verdict, Verdict::explained);
}

/// A limit of the sensor that the simulation shows is no defect seen in the samples only, and the
/// model with it does simulate better than the linear plant.
TEST(SimulationAnswer, KeepsALimitOfTheSensorThatTheSimulationShows) {
  Explanation found = withFriction(false, {});
  found.before.experiment_count = 4;
  found.simulation.causes[0].what.name = "sens_clip";
  found.simulation.causes[0].fit_after = found.simulation.fit_after = 98;
  found.simulation.causes[0].fit_before = found.simulation.fit_before = 60;
  joinSimulation(&found, {});
  ASSERT_EQ(found.causes.size(), 1u);
  EXPECT_TRUE(test::mentions(found.message, "rises from 60 to 98 %")) << found.message;
}

/// Tests fail, and a constant would simulate better: the sensor's steps explain no part of that.
TEST(SimulationAnswer, SampleDefectsExplainNoPartOfAPoorSimulation) {
  Explanation found = withFriction(false, {ofLikelihood("sens_quant", -271, -271)});
  found.simulation.causes.clear();
  joinSimulation(&found, {});
  EXPECT_EQ(found.verdict, Verdict::unknown);
  EXPECT_TRUE(found.causes.empty());
}

TEST(SimulationAnswer, LeadsWhereCurvesTakeHalfOfTheSquaredErrorAway) {
  SimulationCauses simulation = withFriction(false, {}).simulation;
  EXPECT_EQ(leadingCurves(simulation), (std::vector<std::string>{"plant_coulomb", "act_backlash"}));
  simulation.fit_after = 100 - 10 * std::sqrt(0.51);  // from 90 %
  EXPECT_TRUE(leadingCurves(simulation).empty());
  simulation.fit_after = 100 - 10 * std::sqrt(0.49);
  EXPECT_EQ(leadingCurves(simulation).size(), 2u);
}

/// White residuals alone are no explanation: a lag or a pole makes most errors white.
TEST(SimulationAnswer, ReplacesCausesByWhichTheSimulationGainsLittle) {
  Explanation found = withFriction(true, {ofLikelihood("sens_lag", 90, 90.5)});
  joinSimulation(&found, {});
  ASSERT_EQ(found.causes.size(), 1u);
  EXPECT_EQ(found.causes[0].name, "plant_coulomb");
}

TEST(SimulationAnswer, LeavesWhatPassesWhereCurvesGainLittle) {
  Explanation found = withFriction(true, {ofLikelihood("plant_parameter_spread", 90, 90)});
  found.simulation.fit_after = 91;
  joinSimulation(&found, {});
  ASSERT_EQ(found.causes.size(), 1u);
  EXPECT_EQ(found.causes[0].name, "plant_parameter_spread");
}

TEST(SimulationAnswer, DropsWhatNeitherTestsNorSimulationConfirm) {
  Explanation found = withFriction(
      false, {ofLikelihood("act_hammerstein", 90, 90.1), ofLikelihood("noise_tails", 90, 90)});
  found.simulation.causes.clear();
  found.causes[0].gain->standard_error = found.causes[1].gain->standard_error = 1;
  found.causes[0].gain->lower_90 = found.causes[1].gain->lower_90 = 0.1;
  found.causes[1].group = "noise";
  joinSimulation(&found, {});
  ASSERT_EQ(found.causes.size(), 1u);
  EXPECT_EQ(found.causes[0].name, "noise_tails");
  EXPECT_EQ(found.verdict, Verdict::partly_explained);
  EXPECT_TRUE(test::mentions(found.warnings.at(0), "act_hammerstein: raises the likelihood"));
}

/// A simulation with a fit of -400 % instead of -1600 % explains nothing.
TEST(SimulationAnswer, DropsWhatLeavesAUselessSimulation) {
  for (const double after : {-400., 49., 51.}) {
    Explanation found = withFriction(false, {ofLikelihood("plant_parameter_spread", -1600, after)});
    found.simulation.causes.clear();
    found.causes[0].gain->standard_error = 1;
    found.causes[0].gain->lower_90 = -0.1;
    joinSimulation(&found, {});
    EXPECT_EQ(found.causes.size(), after > 50 ? 1u : 0u);
    EXPECT_EQ(found.verdict, after > 50 ? Verdict::partly_explained : Verdict::unknown);
  }
}

TEST(SimulationAnswer, ChangesNothingWhereTheSimulationWasNotSearched) {
  Explanation found = withFriction(false, {ofLikelihood("noise_step", 90, 89)});
  found.causes[0].group = "noise";
  found.simulation.causes.clear();
  found.simulation.skipped = "fewer than 200 samples";
  joinSimulation(&found, {});
  ASSERT_EQ(found.causes.size(), 1u);
  Explanation nothing = withFriction(true, {});
  nothing.simulation = {};
  nothing.simulation.skipped = "fewer than 200 samples";
  joinSimulation(&nothing, {});
  EXPECT_TRUE(nothing.warnings.empty()) << "what was not simulated fits by no percentage";
}

}  // namespace
}  // namespace uncertainty_identification
