// Linear plants that differ from experiment to experiment need no cause, whatever the search found.
#include "explanation/cause_free_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "support/mentions.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

/// First-order plants whose gains differ by 8 %, at levels of their own, with the input `acting`
/// behind the recorded one.
template <typename Acting>
std::vector<Experiment> plants(int count, const Acting& acting) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> between(2, 8);
  std::vector<Experiment> all;
  for (int r = 0; r < count; ++r) {
    Experiment experiment;
    experiment.id = std::to_string(r);
    experiment.sample_time = 0.1;
    experiment.u.resize(400);
    experiment.y.resize(400);
    const double gain = 1 + 0.08 * normal(random), level = 3 * normal(random);
    double x = 5;
    for (int k = 0; k < 400; ++k) {
      experiment.u[k] = k % 20 == 0 ? between(random) : experiment.u[k - 1];
      experiment.y[k] = level + x + 0.05 * normal(random);
      x += 0.1 * (gain * acting(experiment.u[k]) - x);
    }
    all.push_back(std::move(experiment));
  }
  return all;
}

std::vector<Experiment> linearPlants() {
  return plants(6, [](double u) { return u; });
}

Configuration byDefault() {
  Configuration configuration;
  configuration.nominal_model.orders_auto = true;
  return configuration;
}

Split firstFive(const std::vector<Experiment>& all) {
  Split data;
  data.train.assign(all.begin(), all.begin() + 5);
  data.held.assign(all.begin() + 5, all.end());
  return data;
}

Cause named(const std::string& name) {
  Cause cause;
  cause.name = name;
  cause.group = "actuator";
  return cause;
}

Check failed(const std::string& name) {
  Check check;
  check.name = name;
  check.passed = false;
  return check;
}

/// What the search ends with: a cause, and a test that still fails.
Explanation partly(const Cause& cause, const std::string& failing = "whiteness") {
  Explanation explanation;
  explanation.verdict = Verdict::partly_explained;
  explanation.causes = {cause};
  explanation.warnings = {"an effect of the search raises the likelihood"};
  explanation.checks_before = explanation.checks_after = {failed(failing)};
  return explanation;
}

Explanation compared(Explanation explanation, const Configuration& asked, const Split& data,
                     const AnswerLikelihood& with_causes = {}) {
  SearchProgress progress({}, 0);
  compareWithCauseFreeModel(asked, data, with_causes, progress, &explanation);
  return explanation;
}

TEST(CauseFreeModel, NeedsNoCauseWhereLinearPlantsDiffer) {
  const Explanation found =
      compared(partly(named("act_quantisation")), byDefault(), firstFive(linearPlants()));
  EXPECT_EQ(found.verdict, Verdict::none);
  EXPECT_TRUE(found.causes.empty());
  EXPECT_TRUE(test::anyMentions(found.warnings, "act_quantisation: not named"));
  EXPECT_TRUE(test::mentions(found.message, "From experiment to experiment the gain differs by"))
      << found.message;
  EXPECT_TRUE(test::mentions(found.message, "held-out data by")) << found.message;
  EXPECT_EQ(found.before.configuration.error_model.basis, BasisKind::parameter_spread);
  for (const Check& check : found.checks_after) EXPECT_TRUE(check.passed) << check.name;
  EXPECT_TRUE(found.pictures.empty()) << "they show another model";
  EXPECT_FALSE(test::anyMentions(found.warnings, "an effect of the search"))
      << "as does this warning";
}

TEST(CauseFreeModel, SaysWhichTestsOfTheNoiseItDoesNotMake) {
  Explanation search = partly(named("act_quantisation"));
  EXPECT_FALSE(
      test::mentions(compared(search, byDefault(), firstFive(linearPlants())).message, "tails"));
  search.checks_before.push_back(failed("tails"));
  const Explanation found = compared(search, byDefault(), firstFive(linearPlants()));
  EXPECT_EQ(found.verdict, Verdict::none);
  EXPECT_TRUE(test::mentions(found.message, "began with (tails)")) << found.message;
}

/// Nothing is wrong, and a tenth of the output and more is left, which gains that differ explain.
TEST(CauseFreeModel, SaysByWhatPlantsDifferWhereNothingIsWrong) {
  Explanation nothing;
  nothing.verdict = Verdict::none;
  nothing.before.experiment_count = 5;
  nothing.held_out_fit = 86;
  const Explanation told = compared(nothing, byDefault(), firstFive(linearPlants()));
  EXPECT_EQ(told.verdict, Verdict::none);
  EXPECT_EQ(told.message.rfind("only the plants differ. From experiment to experiment the gain", 0),
            0u)
      << told.message;
  nothing.held_out_fit = 95;
  EXPECT_EQ(compared(nothing, byDefault(), firstFive(linearPlants())).message, "") << "as it was";
}

TEST(CauseFreeModel, LeavesWhatItDoesNotContradict) {
  const Split data = firstFive(linearPlants());
  EXPECT_EQ(compared(partly(named("sens_quant")), byDefault(), data).causes.size(), 1u)
      << "the samples show it";
  EXPECT_EQ(compared(partly(named("act_lag"), "direction"), byDefault(), data).causes.size(), 1u)
      << "a controller may compute the input";
  Configuration stated;
  stated.nominal_model.orders_auto = false;
  EXPECT_EQ(compared(partly(named("act_lag")), stated, data).causes.size(), 1u)
      << "the user's orders are what is explained";
  Explanation explained = partly(named("act_lag"));
  explained.verdict = Verdict::explained;
  EXPECT_EQ(compared(explained, byDefault(), data).causes.size(), 1u);
}

/// A cause with which held-out experiments are simulated by 99 %; the linear plant does by 86 %.
Cause confirmed(const std::string& name) {
  Cause cause = named(name);
  cause.gain = Gain{};
  cause.gain->nrmse_fit_percent.after = 99;
  return cause;
}

TEST(CauseFreeModel, LeavesACauseThatSimulatesHeldOutDataBetter) {
  const Split data = firstFive(linearPlants());
  Explanation found = partly(confirmed("act_ratelimit"));
  EXPECT_EQ(compared(found, byDefault(), data).causes.size(), 1u);
  for (Check& check : found.checks_before) check.passed = true;
  EXPECT_TRUE(compared(found, byDefault(), data).causes.empty())
      << "nothing was wrong before, and something is with it";
  found = partly(confirmed("plant_product"));
  found.causes[0].simulation.emplace().what.shape = "curve";
  EXPECT_TRUE(compared(found, byDefault(), data).causes.empty()) << "of no simple shape";
}

/// Where gains differ, a weak cause hardly makes the simulation of held-out experiments better.
TEST(CauseFreeModel, LeavesACauseThatMakesTheDataFarLikelier) {
  const Split data = firstFive(linearPlants());
  const Estimate without = Identifier(byDefault()).identify(data.train, data.held, {});
  const double held_out = without.validation.log_density_per_experiment;
  const AnswerLikelihood far{-without.bic / 2 + 60, held_out + 1, 2000};
  const auto causesLeft = [&](const AnswerLikelihood& likelihood) {
    return compared(partly(named("act_quantisation")), byDefault(), data, likelihood).causes.size();
  };
  EXPECT_EQ(causesLeft(far), 1u);
  AnswerLikelihood other = far;
  other.training -= 20;
  EXPECT_EQ(causesLeft(other), 0u) << "not far";
  other = far;
  other.held_out = held_out - 1;
  EXPECT_EQ(causesLeft(other), 0u) << "but not those held out";
  other = far;
  other.samples = 1000;
  EXPECT_EQ(causesLeft(other), 0u) << "of other samples";
  other = far;
  other.causes = {"act_quantisation", "sens_hum"};
  EXPECT_EQ(causesLeft(other), 0u) << "by what is not named, too";
  other = far;
  other.held_out.reset();
  EXPECT_EQ(causesLeft(other), 0u) << "in sample, everything gains";
  other.training += 50;
  EXPECT_EQ(causesLeft(other), 1u);
}

/// All tests pass with a clock of each experiment; they do without it as well.
TEST(CauseFreeModel, IsComparedWithAnExplanationOfDifferencesAlone) {
  const Split data = firstFive(linearPlants());
  Explanation explained = partly(named("exp_clock"));
  explained.verdict = Verdict::explained;
  EXPECT_EQ(compared(explained, byDefault(), data).verdict, Verdict::none);
  explained.causes = {named("plant_parameter_spread"), named("sens_hum")};
  EXPECT_TRUE(compared(explained, byDefault(), data).causes.empty());
  explained.causes = {named("plant_parameter_spread")};
  EXPECT_EQ(compared(explained, byDefault(), data).causes.size(), 1u) << "as in that model";
  explained.causes = {named("exp_clock"), named("act_deadzone")};
  EXPECT_EQ(compared(explained, byDefault(), data).causes.size(), 2u);
}

/// Of levels that differ by 60 times the noise, and gains that differ by more than the steps do.
TEST(CauseFreeModel, LeavesStepsOfTheActuatorWherePlantsDifferInGainAndLevel) {
  const Explanation found = explain(byDefault(), plants(6, [](double u) { return std::round(u); }));
  EXPECT_TRUE(std::any_of(found.causes.begin(), found.causes.end(), [](const Cause& cause) {
    return cause.name == "act_quantisation";
  })) << found.message;
}

TEST(CauseFreeModel, NamesNothingThatDiffersBetweenExperiments) {
  const Explanation found =
      compared(partly(confirmed("exp_clock")), byDefault(), firstFive(linearPlants()));
  EXPECT_EQ(found.verdict, Verdict::none) << "its model has a spread as well";
}

/// The fit of a cause is about the mean of all held-out outputs, to which levels count.
TEST(CauseFreeModel, ComparesFitsAboutTheSameMean) {
  const std::vector<Experiment> all = linearPlants();
  Split data;
  data.train.assign(all.begin(), all.begin() + 4);
  data.held.assign(all.begin() + 4, all.end());
  data.held[1].y.array() += 100;
  Explanation found = partly(confirmed("act_ratelimit"));
  found.causes[0].gain->nrmse_fit_percent.after = 96;  // by the levels alone, 98 or more
  EXPECT_TRUE(compared(found, byDefault(), data).causes.empty());
}

TEST(CauseFreeModel, KeepsWhatTheSamplesShowBesideTheLinearPlant) {
  Explanation before = partly(named("exp_clock"));
  before.causes.push_back(named("sens_outliers"));
  before.causes.back().seen_in_samples = true;
  const Explanation found = compared(before, byDefault(), firstFive(linearPlants()));
  EXPECT_EQ(found.verdict, Verdict::explained);
  ASSERT_EQ(found.causes.size(), 1u);
  EXPECT_EQ(found.causes[0].name, "sens_outliers");
  EXPECT_TRUE(test::mentions(found.message, "Apart from this, only the plants differ. From exp"));
}

/// A controller computes the input from the output: the model that agrees is the controller's.
TEST(CauseFreeModel, IsNoAnswerWhereTheInputFollowsTheOutput) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  std::vector<Experiment> all = linearPlants();
  for (Experiment& experiment : all) {
    double x = 0, load = 0;
    for (int k = 0; k < 400; ++k) {
      load = 0.9 * load + normal(random);
      experiment.y[k] = x + load;
      experiment.u[k] = -2 * experiment.y[k] + 0.1 * normal(random);
      x += 0.1 * (experiment.u[k] - x);
    }
  }
  EXPECT_NE(compared(partly(named("act_lag")), byDefault(), firstFive(all)).verdict, Verdict::none);
}

/// Whether few plants differ by chance or with the input is not to be seen then.
TEST(CauseFreeModel, IsNoAnswerOfFewExperimentsThatItSimulatesPoorly) {
  const auto answered = [](int count, double noise) {
    std::mt19937_64 random(8);
    std::normal_distribution<double> normal(0, noise);
    std::vector<Experiment> all = plants(count, [](double u) { return u; });
    for (Experiment& experiment : all)
      for (int k = 0; k < experiment.samples(); ++k) experiment.y[k] += normal(random);
    Split data;
    data.train.assign(all.begin(), all.end() - 2);
    data.held.assign(all.end() - 2, all.end());
    return compared(partly(named("act_lag")), byDefault(), data);
  };
  EXPECT_EQ(answered(11, 0.4).verdict, Verdict::none);
  EXPECT_EQ(answered(7, 0.1).verdict, Verdict::none);
  const Explanation few = answered(7, 0.4);
  EXPECT_NE(few.verdict, Verdict::none);
  EXPECT_TRUE(few.causes.empty());
  EXPECT_TRUE(test::anyMentions(few.warnings, "so few experiments (5 are fitted to) do not show"));
}

TEST(CauseFreeModel, IsNoAnswerBesideCurvesThatTheSimulationShows) {
  Explanation found = partly(named("act_lag"));
  found.causes.clear();
  found.verdict = Verdict::unknown;
  EXPECT_EQ(compared(found, byDefault(), firstFive(linearPlants())).verdict, Verdict::none);
  found.simulation.causes.resize(1);
  EXPECT_EQ(compared(found, byDefault(), firstFive(linearPlants())).verdict, Verdict::unknown);
}

TEST(CauseFreeModel, LeavesACauseThatWasFoundTwice) {
  Explanation found = partly(named("act_lag"));
  found.simulation.withheld = {"act_lag"};
  EXPECT_EQ(compared(found, byDefault(), firstFive(linearPlants())).causes.size(), 1u);
}

TEST(CauseFreeModel, IsNoAnswerOfFewDataWhereItIsNotTrusted) {
  const std::vector<Experiment> all = linearPlants();
  const Split two{{all[0], all[1]}, {all[0], all[1]}, true};  // too few to show how plants differ
  Explanation unknown = partly(named("act_lag"));
  unknown.causes.clear();
  unknown.verdict = Verdict::unknown;
  EXPECT_EQ(compared(unknown, byDefault(), two).verdict, Verdict::none);
  unknown.simulation.skipped = "fewer than 200 samples";
  EXPECT_EQ(compared(unknown, byDefault(), two).verdict, Verdict::unknown);
}

TEST(CauseFreeModel, LeavesWhatIdentifyDoesNotTest) {
  const Explanation found =
      compared(partly(named("act_lag"), "volatility"), byDefault(), firstFive(linearPlants()));
  EXPECT_EQ(found.verdict, Verdict::partly_explained);
}

TEST(CauseFreeModel, KeepsWhatWasRejectedAndSaysWhatTimeDidNotAllow) {
  const Split data = firstFive(linearPlants());
  Explanation before = partly(named("act_lag"));
  before.before.rejected = {{"short", "it has 6 measured samples"}};
  EXPECT_EQ(compared(before, byDefault(), data).before.rejected.size(), 1u);
  Configuration hurried = byDefault();
  hurried.explanation.time_limit = 1e-6;
  const Explanation found = compared(before, hurried, data);
  EXPECT_EQ(found.causes.size(), 1u);
  EXPECT_TRUE(test::anyMentions(found.warnings, "there was no time to compare"));
}

TEST(CauseFreeModel, KeepsTheCauseWhereTheDataContradictIt) {
  const auto behind_dead_zone = [](double u) { return std::max(u - 4, 0.0); };
  const Explanation found =
      compared(partly(named("act_deadzone")), byDefault(), firstFive(plants(6, behind_dead_zone)));
  EXPECT_EQ(found.verdict, Verdict::partly_explained);
  EXPECT_EQ(found.causes.size(), 1u);
}

TEST(CauseFreeModel, NothingIsNamedInPlantsThatDifferInGainAndLevel) {
  Explanation found = explain(byDefault(), linearPlants());
  EXPECT_EQ(found.verdict, Verdict::none) << found.message;
  EXPECT_TRUE(found.causes.empty());
}

}  // namespace
}  // namespace uncertainty_identification
