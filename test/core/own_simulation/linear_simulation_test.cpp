#include "own_simulation/linear_simulation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/error_message.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

constexpr double kSampleTime = 0.05;

SimulationInput stepInput() { return {kSampleTime, Eigen::VectorXd::Ones(60), {}, {}, {}}; }

Eigen::VectorXd answer(const OwnModelOptions& options, const SimulationInput& input = stepInput()) {
  const auto simulation = makeLinearSimulation(factorsOf(options, input.sample_time), "a model");
  const std::vector<SimulationParameter> parameters = simulation->parameters();
  Eigen::VectorXd values(static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t k = 0; k < parameters.size(); ++k)
    values[static_cast<Eigen::Index>(k)] = parameters[k].value;
  return simulation->run(input, values);
}

std::string namesOf(const OwnModelOptions& options) {
  std::string names;
  for (const SimulationParameter& each : factorsOf(options, kSampleTime).parameters)
    names += each.name + " ";
  return names;
}

double parameter(const OwnModelOptions& options, const std::string& name) {
  for (const SimulationParameter& each : factorsOf(options, kSampleTime).parameters)
    if (each.name == name) return each.value;
  return std::nan("");
}

std::string refusal(const OwnModelOptions& options) {
  return messageOf<ConfigurationError>([&] { factorsOf(options, kSampleTime); });
}

OwnModelOptions coefficients(std::vector<double> num, std::vector<double> den) {
  OwnModelOptions options;
  options.num = Eigen::Map<Eigen::VectorXd>(num.data(), static_cast<Eigen::Index>(num.size()));
  options.den = Eigen::Map<Eigen::VectorXd>(den.data(), static_cast<Eigen::Index>(den.size()));
  return options;
}

TEST(LinearSimulation, IsTheStepResponseOfAFirstOrderLag) {
  OwnModelOptions options;
  options.physical = {{"gain", 2}, {"tau1", 0.4}, {"dead_time", 0.12}};
  const Eigen::VectorXd y = answer(options);
  for (Eigen::Index k = 0; k < y.size(); ++k) {
    const double time = static_cast<double>(k) * kSampleTime - 0.12;
    EXPECT_NEAR(y[k], time <= 0 ? 0 : 2 * (1 - std::exp(-time / 0.4)), 1e-9) << k;
  }
}

TEST(LinearSimulation, FactorsCoefficientsIntoPhysicalParameters) {
  // 6 (s + 5) / ((s + 2) (s^2 + 4 s + 25)): static gain 30/50.
  const OwnModelOptions options = coefficients({6, 30}, {1, 6, 33, 50});
  EXPECT_EQ(namesOf(options), "gain tau1 omega1 zeta1 zero1 dead_time ");
  EXPECT_NEAR(parameter(options, "gain"), 0.6, 1e-9);
  EXPECT_NEAR(parameter(options, "tau1"), 0.5, 1e-9);
  EXPECT_NEAR(parameter(options, "omega1"), 5, 1e-9);
  EXPECT_NEAR(parameter(options, "zeta1"), 0.4, 1e-9);
  EXPECT_NEAR(parameter(options, "zero1"), 0.2, 1e-9);
  OwnModelOptions factors;
  factors.zeros = {"-5"};
  factors.poles = {"-2", "-2+4.582575694955840j", "-2-4.582575694955840j"};
  factors.physical = {{"gain", 6}};
  OwnModelOptions physical;
  physical.physical = {{"gain", 0.6}, {"tau1", 0.5}, {"omega1", 5}, {"zeta1", 0.4}, {"zero1", 0.2}};
  EXPECT_LT((answer(options) - answer(factors)).norm(), 1e-9);
  EXPECT_LT((answer(options) - answer(physical)).norm(), 1e-9);
}

TEST(LinearSimulation, SimulatesIntegratorsAndDirectTerms) {
  const Eigen::VectorXd ramp = answer(coefficients({3}, {1, 0}));
  const Eigen::VectorXd lead = answer(coefficients({1, 1}, {0.5, 1}));  // (1 + s)/(1 + 0.5 s)
  for (Eigen::Index k = 0; k < ramp.size(); ++k) {
    const double time = static_cast<double>(k) * kSampleTime;
    EXPECT_NEAR(ramp[k], 3 * time, 1e-9);
    EXPECT_NEAR(lead[k], 1 + std::exp(-time / 0.5), 1e-9);
  }
}

TEST(LinearSimulation, TransferFunctionsInZFollowTheirRecursion) {
  // (0.2 z + 0.1) / (z^3 - 1.2 z^2 + 0.5 z): one pole at 0 delays, a pair is complex.
  OwnModelOptions options = coefficients({0.2, 0.1}, {1, -1.2, 0.5, 0});
  options.domain = TransferDomain::z;
  EXPECT_EQ(namesOf(options), "gain omega1 zeta1 dead_time ");
  EXPECT_NEAR(parameter(options, "gain"), 1, 1e-9);
  const Eigen::VectorXd y = answer(options);
  Eigen::VectorXd expected(y.size());
  for (Eigen::Index k = 0; k < y.size(); ++k)
    expected[k] = (k >= 1 ? 1.2 * expected[k - 1] : 0) - (k >= 2 ? 0.5 * expected[k - 2] : 0) +
                  (k >= 2 ? 0.2 : 0) + (k >= 3 ? 0.1 : 0);
  EXPECT_LT((y - expected).norm(), 1e-9);
}

TEST(LinearSimulation, SampledPolesThatHaveNoTimeConstantStayAsTheyAre) {
  OwnModelOptions options = coefficients({1}, {1, -0.3, -0.4});  // 0.8 and -0.5
  options.domain = TransferDomain::z;
  EXPECT_EQ(namesOf(options), "gain tau1 dead_time ");
  EXPECT_NEAR(parameter(options, "tau1"), -kSampleTime / std::log(0.8), 1e-9);
  const Eigen::VectorXd y = answer(options);
  EXPECT_NEAR(y[2], 1, 1e-9);
  EXPECT_NEAR(y[3], 1 + 0.3, 1e-9);
  EXPECT_NEAR(y[y.size() - 1], 1 / 0.3, 1e-3);
  OwnModelOptions integrator = coefficients({0.1}, {1, -1});
  integrator.domain = TransferDomain::z;
  EXPECT_NEAR(answer(integrator)[30], 3, 1e-9);
}

TEST(LinearSimulation, RefusesWhatCannotBeSimulated) {
  EXPECT_NE(refusal(coefficients({1}, {1, -2})).find("the pole 2; allowed: poles in the left"),
            std::string::npos);
  EXPECT_NE(refusal(coefficients({1, 0, 0}, {1, 2})).find("2 zeros and 1 poles"),
            std::string::npos);
  EXPECT_NE(refusal(coefficients({0, 0}, {1, 2})).find("simulation.model.num: found zeros only"),
            std::string::npos);
  OwnModelOptions alone;
  alone.poles = {"-1+2j"};
  EXPECT_NE(refusal(alone).find("found -1+2j alone"), std::string::npos);
  alone.poles = {"-1+j2"};
  EXPECT_NE(refusal(alone).find("found '-1+j2'; allowed: numbers such as"), std::string::npos);
  OwnModelOptions half;
  half.physical = {{"omega1", 3}};
  EXPECT_NE(refusal(half).find("simulation.model.zeta1: found nothing"), std::string::npos);
  OwnModelOptions slow = coefficients({1}, {1, -0.5});
  slow.domain = TransferDomain::z;
  slow.sample_time = 0.1;
  EXPECT_NE(refusal(slow).find("simulation.model.sample_time: found 0.1"), std::string::npos);
}

TEST(LinearSimulation, ParametersThatCannotBeSimulatedGiveNoNumbers) {
  OwnModelOptions options;
  options.physical = {{"gain", 2}, {"tau1", 0.4}};
  const auto simulation = makeLinearSimulation(factorsOf(options, kSampleTime), "a model");
  EXPECT_TRUE(simulation->run(stepInput(), Eigen::Vector3d(2, 0.4, 0)).allFinite());
  EXPECT_TRUE(std::isnan(simulation->run(stepInput(), Eigen::Vector3d(2, -0.4, 0))[5]));
  EXPECT_TRUE(std::isnan(simulation->run(stepInput(), Eigen::Vector3d(2, 0.4, -1))[5]));
}

}  // namespace
}  // namespace uncertainty_identification
