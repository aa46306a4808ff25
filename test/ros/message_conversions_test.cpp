#include "ros/message_conversions.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/error_message.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

Experiment makeExperiment() {
  Experiment experiment;
  experiment.id = "one";
  experiment.sample_time = 0.04;
  experiment.start_time = 1649348542.22;
  experiment.u = Eigen::VectorXd::Random(5);
  experiment.y = Eigen::VectorXd::Random(5);
  experiment.valid = {1, 1, 0, 1, 1};
  experiment.scalars["load"] = 2.5;
  experiment.signals["temp"] = Eigen::VectorXd::Random(5);
  experiment.stamp_offset = 1e-4 * Eigen::VectorXd::Random(5);
  return experiment;
}

Estimate makeEstimate() {
  Estimate estimate;
  estimate.nominal_model.structure = "box_jenkins";
  estimate.nominal_model.sample_time = 0.01;
  estimate.nominal_model.delay = 3;
  estimate.nominal_model.b = Eigen::Vector2d(1, 2);
  estimate.nominal_model.a = Eigen::VectorXd::Constant(1, 0.5);
  estimate.nominal_model.c = Eigen::VectorXd::Constant(1, 0.1);
  estimate.nominal_model.d = Eigen::VectorXd::Constant(1, 0.8);
  estimate.nominal_model.parameters = {{"b1", "m", 1, 0.1, 0.2}, {"b2", "", 2, 0.3, 0.4}};
  estimate.nominal_model.covariance = (Eigen::Matrix2d() << 1, 2, 3, 4).finished();
  estimate.error_model.options.basis = BasisKind::kautz;
  estimate.error_model.options.constraint = Constraint::explicit_matrix;
  estimate.error_model.T = (Eigen::MatrixXd(3, 2) << 1, 2, 3, 4, 5, 6).finished();
  estimate.error_model.mixture.weights = {0.25, 0.75};
  estimate.error_model.mixture.means = {Eigen::Vector2d(-1, 1), Eigen::Vector2d(2, 3)};
  estimate.error_model.mixture.covariances = {Eigen::Matrix2d::Identity(),
                                              (Eigen::Matrix2d() << 4, 1, 1, 5).finished()};
  estimate.noise_variance.value = 0.1;
  estimate.noise_variance.standard_error = 0.01;
  estimate.termination = Termination::iteration_limit;
  estimate.message = "stopped";
  estimate.experiment_count = 7;
  estimate.data_fingerprint = "0123456789abcdef";
  estimate.log_likelihood = -12.5;
  estimate.warnings = {"a warning"};
  return estimate;
}

TEST(MessageConversions, ExperimentComesBack) {
  const Experiment experiment = makeExperiment();
  const Experiment back = fromMessage(toMessage(experiment));
  EXPECT_EQ(back.id, experiment.id);
  EXPECT_EQ(back.sample_time, experiment.sample_time);
  EXPECT_EQ(back.start_time, experiment.start_time);
  EXPECT_EQ(back.u, experiment.u);
  EXPECT_EQ(back.y, experiment.y);
  EXPECT_EQ(back.valid, experiment.valid);
  EXPECT_EQ(back.scalars, experiment.scalars);
  ASSERT_EQ(back.signals.size(), 1U);
  EXPECT_EQ(back.signals.at("temp"), experiment.signals.at("temp"));
  EXPECT_EQ(back.stamp_offset, experiment.stamp_offset);
}

TEST(MessageConversions, BadExperimentsAreNamed) {
  const messages::Experiment good = toMessage(makeExperiment());
  const auto message = [&](const auto& change) {
    messages::Experiment bad = good;
    change(bad);
    return messageOf<DataError>([&] { fromMessage(bad); });
  };
  EXPECT_NE(message([](auto& e) { e.valid.pop_back(); }).find("'one': valid has 4 values"),
            std::string::npos);
  EXPECT_NE(message([](auto& e) { e.stamp_offset.pop_back(); }).find("stamp_offset has 4"),
            std::string::npos);
  EXPECT_NE(message([](auto& e) { e.covariates[0].values.clear(); }).find("'load' is constant"),
            std::string::npos);
  EXPECT_NE(message([](auto& e) { e.covariates[1].values.clear(); }).find("'temp' has 0 values"),
            std::string::npos);
  EXPECT_NE(message([](auto& e) { e.covariates[1].name = "load"; }).find("given twice"),
            std::string::npos);
  EXPECT_NE(message([](auto& e) { e.covariates[1].kind = 7; }).find("of kind 7"),
            std::string::npos);
  EXPECT_NE(message([](auto& e) { e.covariates[1].name = ""; }).find("no name"), std::string::npos);
}

TEST(MessageConversions, StartOutsideWhatStampsExpressIsRefused) {
  Experiment experiment = makeExperiment();
  for (const double start : {-1., 5e9, std::numeric_limits<double>::quiet_NaN()}) {
    experiment.start_time = start;
    EXPECT_THROW(toMessage(experiment), DataError) << start;
  }
}

TEST(MessageConversions, ModelsCarryEveryNumberRowMajor) {
  const ResultContext context{ros::Time(5, 0).toNSec(), 9, true, {2, "a", "b", 1, 3.5}};
  const auto message = toMessage(makeEstimate(), context);
  EXPECT_EQ(message.header.stamp, ros::Time(5, 0));
  EXPECT_EQ(message.sequence, 9U);
  EXPECT_TRUE(message.preliminary);
  EXPECT_EQ(message.termination, messages::IdentificationResult::ITERATION_LIMIT);
  EXPECT_EQ(message.experiment_count, 7U);
  EXPECT_EQ(message.window_end, ros::Time(3, 500000000));

  const auto& nominal = message.nominal_model;
  EXPECT_EQ(nominal.sequence, 9U);
  EXPECT_EQ(nominal.delay, 3U);
  EXPECT_EQ(nominal.b, (std::vector<double>{1, 2}));
  EXPECT_EQ(nominal.d, (std::vector<double>{0.8}));
  EXPECT_EQ(nominal.covariance, (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(nominal.parameters[1].robust_standard_error, 0.4);
  EXPECT_EQ(nominal.noise_variance, 0.1);

  const auto& error = message.error_model;
  EXPECT_EQ(error.basis, messages::ErrorModel::KAUTZ);
  EXPECT_EQ(error.constraint, messages::ErrorModel::EXPLICIT);
  EXPECT_EQ(error.taps, 3U);
  EXPECT_EQ(error.dimension, 2U);
  EXPECT_EQ(error.pole_imaginary, 0.3);
  EXPECT_EQ(error.T, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  ASSERT_EQ(error.components.size(), 2U);
  EXPECT_EQ(error.components[1].mean, (std::vector<double>{2, 3}));
  EXPECT_EQ(error.components[1].covariance, (std::vector<double>{4, 1, 1, 5}));

  EXPECT_EQ(error.sensitivity_order, 0);
  EXPECT_TRUE(error.varied_parameters.empty());

  const auto json = nlohmann::json::parse(message.result_json);
  EXPECT_EQ(json["nominal_model"]["b"], (std::vector<double>{1, 2}));
  EXPECT_EQ(nlohmann::json::parse(message.configuration), json["configuration"]);
}

TEST(MessageConversions, ErrorsOfParametersNameThem) {
  Estimate estimate = makeEstimate();
  ErrorModelOptions& options = estimate.error_model.options;
  options.basis = BasisKind::sensitivity;
  options.sensitivity_order = 2;
  options.parameters = {"b1", "a1"};
  const ResultContext context{ros::Time(5, 0).toNSec(), 9, true, {2, "a", "b", 1, 3.5}};
  const auto message = toErrorModelMessage(estimate, context);
  EXPECT_EQ(message.basis, messages::ErrorModel::SENSITIVITY);
  EXPECT_EQ(message.sensitivity_order, 2);
  EXPECT_EQ(message.varied_parameters, (std::vector<std::string>{"b1", "a1"}));
  options.basis = BasisKind::parameter_spread;
  EXPECT_EQ(toErrorModelMessage(estimate, context).basis, messages::ErrorModel::PARAMETER_SPREAD);
  EXPECT_EQ(toErrorModelMessage(estimate, context).sensitivity_order, 1);
}

}  // namespace
}  // namespace uncertainty_identification
