// Each finding that speaks against a model, by itself. Data: a first-order plant, simulated.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "identification/identify.h"
#include "identification/steps.h"
#include "simulation/simulate.h"
#include "support/core_setup.h"
#include "support/mentions.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

class TrustOf : public testing::Test {
 protected:
  void SetUp() override {
    Truth truth;
    truth.sample_time = 0.1;
    truth.experiments = 8;
    truth.samples = {100};
    truth.plant.b = test::vectorOf({0.2});
    truth.plant.a = test::vectorOf({-0.8});
    truth.noise.variance = 1e-3;
    Configuration configuration;
    configuration.nominal_model.orders_auto = false;
    configuration.nominal_model.structure = Structure::output_error;
    configuration.error_model.taps = 0;
    data_ = checkData(configuration, simulate(truth, 1), &journal_);
    problem_.configuration = limitErrorModel(configuration, data_.count(), &journal_);
    problem_.configuration = chooseInitialState(problem_.configuration, data_, &journal_);
    fitted_ = fitModel(problem_, &journal_);
    estimate_ = describe(problem_, fitted_, &journal_);
    ASSERT_TRUE(trusted());
  }

  Trust trust() { return trustOf(fitted_, estimate_); }
  bool trusted() { return trust().trusted; }

  void expectReason(const std::string& words) {
    const Trust found = trust();
    EXPECT_FALSE(found.trusted);
    ASSERT_EQ(found.reasons.size(), 1u);
    EXPECT_TRUE(test::mentions(found.reasons[0], words)) << found.reasons[0];
  }

  Journal journal_{ProgressPhases({})};
  CheckedData data_;
  Problem problem_{data_, {}, nullptr, {}, {}, {}};
  FittedModel fitted_;
  Estimate estimate_;
};

TEST_F(TrustOf, AValidationThatTheModelDoesNotSimulate) {
  Validation validation;
  const auto after = [&](std::optional<double> own_fit) {
    return trustAfterValidation(trust(), validation, own_fit);
  };
  EXPECT_TRUE(after(99).trusted) << "there is none";
  validation.experiments = {"held out"};
  validation.simulation_fit_percent_pooled = 60;
  EXPECT_TRUE(after({}).trusted);
  EXPECT_TRUE(after(70).trusted);
  ASSERT_EQ(after(99).reasons.size(), 1u);
  EXPECT_FALSE(after(99).trusted);
  EXPECT_TRUE(
      test::mentions(after(99).reasons[0], "far worse (fit 60 %) than those fitted to (99"));
  validation.simulation_fit_percent_pooled = 92;
  EXPECT_TRUE(after(99.9).trusted) << "it is simulated well";
  validation.simulation_fit_percent_pooled = 12;
  ASSERT_EQ(after(99).reasons.size(), 1u);
  EXPECT_FALSE(after({}).trusted);
  EXPECT_TRUE(test::mentions(after({}).reasons.at(0), "fit 12 %"));
}

TEST_F(TrustOf, ResidualsOfAPlantThatIsNotLinear) {
  estimate_.residual_tests.linearity_p_value = 1e-9;
  estimate_.residual_tests.nonlinear_share = 0.001;
  EXPECT_TRUE(trusted()) << "of no consequence";
  estimate_.residual_tests.nonlinear_share = 0.01;
  expectReason("not linear");
}

TEST_F(TrustOf, AnEstimateThatDidNotConverge) {
  estimate_.termination = Termination::stalled;
  expectReason("did not converge");
  estimate_.termination = Termination::iteration_limit;
  expectReason("did not converge");
}

TEST_F(TrustOf, FewExperiments) {
  estimate_.experiment_count = 3;
  expectReason("3 experiments are too few");
  estimate_.experiment_count = 4;
  EXPECT_TRUE(trusted());
  estimate_.experiment_count = 1;
  EXPECT_TRUE(trusted()) << "a single record has no bounds that could be wrong";
}

TEST_F(TrustOf, ResidualsThatDependOnTheInputOrAreNotWhite) {
  ResidualTests& tests = estimate_.residual_tests;
  const ResidualTests passed = tests;
  tests.independence_p_value = 1e-4;
  tests.cross_correlation[3] = 0.1;
  expectReason("still depend on the input (p = 0.0001)");
  for (double& value : tests.cross_correlation) value = 0.02;
  EXPECT_TRUE(trusted()) << "improbable in so many samples, but too small to matter";
  tests = passed;
  tests.whiteness_p_value = 1e-4;
  tests.autocorrelation[0] = -0.1;
  expectReason("are not white");
  tests.whiteness_p_value = 0.01;
  EXPECT_TRUE(trusted());
}

TEST_F(TrustOf, ExperimentsThatScatterMoreThanTheModelSays) {
  ParameterEstimate& parameter = estimate_.nominal_model.parameters[0];
  parameter.robust_standard_error = 2.9 * parameter.standard_error;
  EXPECT_TRUE(trusted());
  parameter.robust_standard_error = 3.5 * parameter.standard_error;
  expectReason("scatter 3.5 times as much in b1");
}

TEST_F(TrustOf, ParametersThatTheDataDoNotDetermine) {
  estimate_.nominal_model.parameters[0].standard_error = std::nan("");
  expectReason("do not determine every parameter of the nominal model (b1 without");
}

TEST_F(TrustOf, APoleAtTheEdgeOfStability) {
  estimate_.nominal_model.a = test::vectorOf({-0.9999});
  expectReason("edge of stability");
}

TEST(TrustOfLength, RecordsShorterThanTheSlowestTimeConstantExtrapolate) {
  const double constant = 100;  // [samples]
  const Eigen::VectorXd slow = test::vectorOf({-std::exp(-1 / constant)});
  const Trust found = trustOfLength({}, slow, 140);
  EXPECT_FALSE(found.trusted);
  ASSERT_EQ(found.reasons.size(), 1u);
  EXPECT_TRUE(test::mentions(found.reasons[0], "slowest time constant")) << found.reasons[0];
  EXPECT_TRUE(trustOfLength({}, slow, 160).trusted);
}

TEST(TrustOfOrders, ThatSimulateHeldOutDataFarWorseIsNotGiven) {
  const auto found = [](double held_out, double fit, long poles = 2) {
    Candidate chosen, other;
    chosen.choice = other.choice = "orders";
    chosen.description = "output_error nb=2 na=2 delay=1";
    other.description = "output_error nb=3 na=3 delay=1";
    chosen.chosen = true;
    chosen.validation_fit = held_out;
    other.validation_fit = 10;
    return trustOfOrders({}, {other, chosen}, poles, fit);
  };
  EXPECT_TRUE(found(72, 74).trusted);
  EXPECT_TRUE(found(95, 99.9).trusted) << "good enough";
  const Trust far = found(52, 87);
  ASSERT_EQ(far.reasons.size(), 1u);
  EXPECT_FALSE(far.trusted);
  EXPECT_TRUE(test::mentions(far.reasons[0], "(fit 52 %)")) << far.reasons[0];
  EXPECT_TRUE(found(52, 87, 1).trusted) << "the likelihood chose other orders since";
}

TEST(TrustOfInputs, AnOutputThatWrapsIsNotTrusted) {
  CheckedData data;
  data.experiments.resize(1);
  Experiment& angle = data.experiments[0];
  angle.u = Eigen::VectorXd::LinSpaced(400, 0, 1);
  angle.y.resize(400);
  for (int k = 0; k < 400; ++k) angle.y[k] = std::fmod(5.0 * k, 360.0);
  const Trust found = trustOfInputs({}, data);
  ASSERT_EQ(found.reasons.size(), 1u);
  EXPECT_TRUE(test::mentions(found.reasons[0], "record it unwrapped")) << found.reasons[0];
  angle.y = angle.u;
  EXPECT_TRUE(trustOfInputs({}, data).trusted);
}

TEST_F(TrustOf, ASimulationThatExplainsLittle) {
  ASSERT_TRUE(estimate_.simulation_fit_percent.has_value());
  EXPECT_GT(*estimate_.simulation_fit_percent, 90);
  fitted_.optimum.point.parameters[0] = 0;  // b1
  const Estimate without_gain = describe(problem_, fitted_, &journal_);
  EXPECT_LT(*without_gain.simulation_fit_percent, 10);
  estimate_.simulation_fit_percent = without_gain.simulation_fit_percent;
  expectReason("explains little of the output");
}

TEST(TrustOfDirection, NeedsAnOutputThatComesAfterTheInput) {
  Following following;
  following.measured = true;
  following.chance = 0.1;
  following.after = 0.9;
  const auto reasons = [&](bool delay_is_chosen) {
    return trustOfDirection({}, following, 0, delay_is_chosen).reasons;
  };
  EXPECT_TRUE(reasons(false).empty()) << "the delay was stated";
  ASSERT_EQ(reasons(true).size(), 1u);
  EXPECT_TRUE(test::mentions(reasons(true)[0], "the inverse of the controller"));
  following.after = 0.5;
  EXPECT_TRUE(reasons(true).empty()) << "most of the output is something else";
  following.after = 0.9;
  following.delay = 0.1;
  EXPECT_TRUE(reasons(true).empty());
  following.before = 0.6;
  EXPECT_TRUE(test::mentions(reasons(false).at(0), "closed loop"));
}

TEST(TrustOfDirection, NeedsAnInputThatIsNotComputedFromTheSameReading) {
  Following following;
  following.at_once.samples = 100;
  following.at_once.correlation = -0.9;
  EXPECT_TRUE(trustOfDirection({}, following, 0, false).trusted) << "the delay was stated";
  EXPECT_TRUE(test::mentions(trustOfDirection({}, following, 0, true).reasons.at(0),
                             "the inverse of the controller"));
  EXPECT_TRUE(test::mentions(trustOfDirection({}, following, 3, true).reasons.at(0),
                             "the model answers later"));
  following.at_once.correlation = -0.39;
  EXPECT_TRUE(trustOfDirection({}, following, 3, true).trusted) << "chance reaches as much";
}

/// A first-order plant in a loop: u(k) = -2 y(k) + r(k), with more noise than reference.
TEST(TrustOfDirection, TheInverseOfAControllerIsNotTrusted) {
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  Experiment loop;
  loop.id = "loop";
  loop.sample_time = 0.1;
  loop.u = loop.y = Eigen::VectorXd::Zero(400);
  double state = 0;
  for (Eigen::Index k = 0; k < 400; ++k) {
    loop.y[k] = state;
    loop.u[k] = -2 * loop.y[k] + 0.3 * normal(engine);
    state = 0.8 * state + 0.2 * loop.u[k] + normal(engine);
  }
  const Estimate estimate = Identifier(Configuration()).identify({loop});
  EXPECT_FALSE(estimate.trust.trusted);
  EXPECT_TRUE(std::any_of(estimate.trust.reasons.begin(), estimate.trust.reasons.end(),
                          [](const std::string& reason) {
                            return test::mentions(reason, "the inverse of the controller");
                          }))
      << estimate.nominal_model.delay;
}

/// Steps that are recorded from their beginning on, of plants whose gain differs by 5 %: offsets of
/// their own, or slow noise, take these differences up, and bands were far too narrow.
TEST(StepsFromTheFirstSample, DoNotShowHowTheGainDiffers) {
  std::mt19937_64 engine(77);
  std::normal_distribution<double> normal;
  std::vector<Experiment> steps;
  for (const double level : {1.0, 2.0, -1.5, 3.0, 0.7, -2.5, 1.4, -0.8}) {
    Experiment step;
    step.id = "step to " + std::to_string(level);
    step.sample_time = 0.05;
    step.u = Eigen::VectorXd::Constant(120, level);
    step.y.resize(120);
    const double gain = 2 * (1 + 0.05 * normal(engine));
    double state = 0;
    for (Eigen::Index k = 0; k < step.y.size(); ++k) {
      step.y[k] = state + 0.02 * normal(engine);
      state = 0.92 * state + 0.08 * gain * level;
    }
    steps.push_back(std::move(step));
  }
  const Estimate estimate = Identifier(Configuration()).identify(steps);
  EXPECT_NE(estimate.configuration.estimation.offsets, Offsets::per_experiment);
  EXPECT_FALSE(estimate.trust.trusted);
  EXPECT_TRUE(std::any_of(
      estimate.trust.reasons.begin(), estimate.trust.reasons.end(),
      [](const std::string& reason) { return test::mentions(reason, "inputs are constant"); }));
}

TEST(TrustAfterCalibration, WidensNoDoubtBelowOneAndAHalf) {
  PredictionCalibration calibration;
  calibration.levels = {0.5, 0.95};
  calibration.radius = {1.0, 2.8};
  calibration.model_radius = {1.0, 2.0};
  EXPECT_TRUE(trustAfterCalibration({}, calibration).trusted);
  calibration.radius[1] = 3.2;
  const Trust trust = trustAfterCalibration({}, calibration);
  EXPECT_FALSE(trust.trusted);
  EXPECT_TRUE(test::mentions(trust.reasons.at(0), "1.6 times as large"));
}

}  // namespace
}  // namespace uncertainty_identification
