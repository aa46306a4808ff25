// The Identifier with effects that a configuration names.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "support/core_setup.h"
#include "support/error_message.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/identifier.h"
#include "uncertainty_identification/io/result_json.h"

namespace uncertainty_identification {
namespace {

constexpr double kWidth = 0.8, kBias = 0.7;
constexpr int kExperiments = 60;

/// The paper's Example 1 behind a dead zone (commands are larger by its width than what acts), its
/// sensor with a bias drawn for each experiment.
std::vector<Experiment> experiments() {
  std::vector<Experiment> all = test::example1(3, kExperiments).experiments;
  std::mt19937_64 engine(4);
  std::normal_distribution<double> normal;
  for (Experiment& experiment : all) {
    experiment.u += kWidth * experiment.u.cwiseSign();
    experiment.y.array() += kBias * normal(engine);
  }
  return all;
}

Configuration configuration() {
  Configuration of = test::example1Configuration();
  of.bounds.frequencies = 0;
  of.effects = {{"act_deadzone", "", {}}, {"sens_bias", "per_experiment", {}}};
  return of;
}

const Estimate& estimate() {
  static const Estimate kEstimate = Identifier(configuration()).identify(experiments());
  return kEstimate;
}

TEST(IdentifiedEffects, AreEstimatedWithTheRest) {
  ASSERT_TRUE(estimate().usable()) << estimate().message;
  ASSERT_EQ(estimate().effects.size(), 2u);
  const ParameterEstimate& width = estimate().effects[0].parameters.at(0);
  EXPECT_EQ(estimate().effects[0].name, "act_deadzone");
  EXPECT_EQ(width.name, "width");
  EXPECT_EQ(width.unit, "unit of u");
  EXPECT_GT(width.standard_error, 0);
  EXPECT_LT(width.standard_error, 0.05);
  EXPECT_NEAR(width.value, kWidth, 4 * width.standard_error);
  // of a standard deviation from 60 draws: relative standard error 1/sqrt(120)
  const ParameterEstimate& bias = estimate().effects[1].parameters.at(0);
  EXPECT_EQ(estimate().effects[1].variant, "per_experiment");
  EXPECT_NEAR(bias.value, kBias, 4 * kBias / std::sqrt(120.0));
  EXPECT_NEAR(estimate().noise_variance.value, 0.1, 4 * estimate().noise_variance.standard_error);
  EXPECT_NEAR(estimate().nominal_model.b[0], 1, 0.1);
}

/// Sensors curved alike, plants whose pole differs by experiment; white noise of variance 0.1.
std::vector<Experiment> curvedAndSpread(double curvature, double spread) {
  std::vector<Experiment> all = test::example1(3, kExperiments).experiments;
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  for (Experiment& experiment : all) {
    const double pole = 0.5 * (1 + spread * normal(engine));
    double x = 0;
    for (int t = 0; t < experiment.samples(); ++t) {
      experiment.y[t] = x + curvature * x * x + std::sqrt(0.1) * normal(engine);
      x = pole * x + experiment.u[t];
    }
  }
  return all;
}

Configuration withoutErrorModel(const std::string& effect, const std::string& variant) {
  Configuration of = test::atRest(1, 1, 0, 0, 1);
  of.error_model.taps = 0;
  of.bounds.frequencies = 0;
  of.effects = {{effect, variant, {}}};
  return of;
}

TEST(IdentifiedEffects, NeedNoErrorModel) {
  const Estimate found =
      Identifier(withoutErrorModel("sens_wiener", "")).identify(curvedAndSpread(0.1, 0));
  ASSERT_TRUE(found.usable()) << found.message;
  const ParameterEstimate& c2 = found.effects.at(0).parameters.at(0);
  EXPECT_NEAR(c2.value, 0.1, 4 * c2.standard_error);
  EXPECT_NEAR(found.noise_variance.value, 0.1, 4 * found.noise_variance.standard_error);
}

/// Poles that differ by a third: to first order about the common one the noise comes out larger.
TEST(IdentifiedEffects, AParameterMayVaryWidely) {
  const Estimate found = Identifier(withoutErrorModel("plant_parameter_spread", "a1"))
                             .identify(curvedAndSpread(0, 0.3));
  ASSERT_TRUE(found.usable()) << found.message;
  EXPECT_NEAR(found.effects.at(0).parameters.at(0).value, 0.3, 4 * 0.3 / std::sqrt(120.0));
  EXPECT_NEAR(found.nominal_model.a[0], -0.5, 4 * 0.15 / std::sqrt(60.0));
  EXPECT_NEAR(found.noise_variance.value, 0.1, 4 * found.noise_variance.standard_error);
}

TEST(IdentifiedEffects, AreStartedFromAnEarlierEstimate) {
  const Estimate again = Identifier(configuration()).reidentify(estimate(), experiments());
  EXPECT_NEAR(again.log_likelihood, estimate().log_likelihood, 0.01);
  Configuration evaluate = configuration();
  evaluate.estimation.max_iterations = 0;
  const Estimate start = Identifier(evaluate).reidentify(estimate(), experiments());
  EXPECT_NEAR(start.log_likelihood, estimate().log_likelihood, 0.01);
  // A millionth of these values: the likelihood is flat there, and rounding, which depends on the
  // processor, decides whether a last step is taken. Standard errors are a hundredth of them.
  constexpr double kLastStep = 1e-6;
  EXPECT_NEAR(start.effects.at(0).parameters.at(0).value, estimate().effects[0].parameters[0].value,
              kLastStep);
  EXPECT_NEAR((start.nominal_model.b - estimate().nominal_model.b).norm(), 0, kLastStep);
}

TEST(IdentifiedEffects, AreKeptByResultJson) {
  const Estimate loaded = estimateFromJson(toJson(estimate()));
  EXPECT_EQ(toJson(loaded), toJson(estimate()));
  ASSERT_EQ(loaded.effects.size(), 2u);
  EXPECT_EQ(loaded.effects[1].parameters[0].value, estimate().effects[1].parameters[0].value);
  EXPECT_EQ(loaded.configuration.effects.size(), 2u);
}

TEST(IdentifiedEffects, StartFromTheValuesGiven) {
  Configuration given = configuration();
  given.effects[0].parameters = {{"width", 0.75}};
  const Estimate from_there = Identifier(given).identify(experiments());
  EXPECT_NEAR(from_there.log_likelihood, estimate().log_likelihood, 0.01);
  given.effects[0].parameters = {{"with", 0.75}};
  EXPECT_NE(messageOf<ConfigurationError>([&] {
              Identifier(given).identify(experiments());
            }).find("it has width"),
            std::string::npos);
}

}  // namespace
}  // namespace uncertainty_identification
