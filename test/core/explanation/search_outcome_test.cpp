// What the samples show without a model, by how much of the noise it is.
#include "explanation/search_outcome.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "explanation/estimate_fit.h"
#include "explanation/split.h"
#include "support/core_setup.h"
#include "support/error_message.h"
#include "support/mentions.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

/// Example 1 read in steps of `step` standard deviations of its noise.
Explanation explainRounded(double step) {
  test::RandomSystem system = test::example1(2, 20);
  step *= std::sqrt(system.truth.noise_variance);
  for (Experiment& experiment : system.experiments)
    experiment.y = step * (experiment.y / step).array().round().matrix();
  Configuration configuration = test::example1Configuration();
  configuration.bounds.frequencies = 0;
  return explain(configuration, system.experiments);
}

bool tellsOfSteps(const Explanation& found) {
  return std::any_of(found.warnings.begin(), found.warnings.end(), [](const std::string& warning) {
    return test::mentions(warning, "of the noise variance");
  });
}

/// Steps of 2 deviations add a third of the noise's own variance: a quarter of what is seen.
TEST(SearchOutcome, StepsThatAreASmallPartOfTheNoiseAreToldAndExplainNothing) {
  const Explanation found = explainRounded(2);
  EXPECT_EQ(found.verdict, Verdict::none) << found.message;
  EXPECT_TRUE(tellsOfSteps(found));
}

TEST(SearchOutcome, StepsThatAreMostOfTheNoiseAreACause) {
  const Explanation found = explainRounded(6);
  ASSERT_EQ(found.causes.size(), 1u) << found.message;
  EXPECT_EQ(found.causes[0].name, "sens_quant");
  EXPECT_FALSE(tellsOfSteps(found));
}

TEST(SearchOutcome, AModelThatCannotBeEvaluatedIsAnError) {
  const test::RandomSystem system = test::example1(2, 4);
  const Configuration configuration = test::example1Configuration();
  Estimate estimate = Identifier(configuration).identify(system.experiments);
  estimate.nominal_model.a[0] = -2;  // a pole far outside the unit circle
  estimate.nominal_model.parameters.clear();
  const Split data{system.experiments, system.experiments, true};
  const auto search = [&] {
    searchOnTopOf(configuration.explanation, contextOf(estimate, 1), estimate, data, {}, {});
  };
  EXPECT_TRUE(test::mentions(messageOf<DataError>(search), "cannot be evaluated"));
}

/// Whether effects were tried that differ from experiment to experiment.
bool triesDifferences(int fitted, int held_out) {
  const std::vector<Experiment> all = test::example1(2, fitted + held_out).experiments;
  Configuration configuration = test::example1Configuration();
  configuration.bounds.frequencies = 0;
  configuration.error_model = ErrorModelOptions();
  configuration.error_model.taps = 0;
  const Explanation found = explain(configuration, {all.begin(), all.begin() + fitted},
                                    {all.begin() + fitted, all.end()});
  return std::any_of(found.candidates.begin(), found.candidates.end(), [](const TriedEffect& each) {
    return each.name == "exp_clock" || each.variant == "per_experiment";
  });
}

TEST(SearchOutcome, TwoExperimentsDoNotShowThatSomethingDiffersBetweenExperiments) {
  EXPECT_FALSE(triesDifferences(1, 2));
  EXPECT_FALSE(triesDifferences(2, 1));
  EXPECT_TRUE(triesDifferences(8, 2));
}

/// Runs of a motor whose sensor also reads a vibration of 1.7 Hz, of which each has another phase.
std::vector<Experiment> vibratingMotors() {
  std::mt19937_64 engine(6);
  std::normal_distribution<double> normal;
  std::vector<Experiment> all(10);
  for (Experiment& each : all) {
    each.id = "run_" + std::to_string(&each - all.data());
    each.sample_time = 0.01;
    each.u.resize(600);
    each.y.resize(600);
    const double phase = 10 * normal(engine);
    double x = 0, noise = 0;
    for (int t = 0; t < 600; ++t) {
      each.u[t] = t % 3 == 0 ? normal(engine) : each.u[t - 1];
      noise = 0.9 * noise + 0.006 * normal(engine);
      each.y[t] = x + 0.15 * std::sin(2 * M_PI * 1.7 * 0.01 * t + phase) + noise;
      x = 0.9 * x + 0.1 * each.u[t];
    }
  }
  return all;
}

/// A plant of higher order holds it as well, as poles that nothing damps.
TEST(SearchOutcome, AnOscillationThatNothingDampsIsNoPlant) {
  Configuration configuration;
  configuration.nominal_model.orders_auto = true;
  const Explanation found = explain(configuration, vibratingMotors());
  ASSERT_EQ(found.causes.size(), 1u) << found.message;
  EXPECT_EQ(found.causes[0].name, "sens_hum");
  EXPECT_FALSE(test::anyMentions(found.warnings, "a linear model fitted to its simulation reaches"))
      << "one that oscillates for ever";
}

}  // namespace
}  // namespace uncertainty_identification
