#include "uncertainty_identification/bounds/physical_numbers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "support/core_setup.h"
#include "support/plain_estimate.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {
namespace {

using test::estimateWithoutErrorModel;
using test::vectorOf;

constexpr double kPlainSampleTime = 0.1;  // [s] of plainEstimate()

const PhysicalNumber* find(const PhysicalNumbers& physical, const std::string& name) {
  for (const PhysicalNumber& number : physical.numbers) {
    if (number.name == name) return &number;
  }
  return nullptr;
}

const PhysicalNumber& numberOf(const PhysicalNumbers& physical, const std::string& name) {
  static const PhysicalNumber kMissing{"missing", "", NAN};
  const PhysicalNumber* found = find(physical, name);
  EXPECT_NE(found, nullptr) << name;
  return found != nullptr ? *found : kMissing;
}

/// 8.2/(1 + 2 s) with a zero-order hold.
Estimate firstOrder(double error = 1e-6) {
  const double pole = std::exp(-kPlainSampleTime / 2);
  return estimateWithoutErrorModel(vectorOf({8.2 * (1 - pole)}), vectorOf({-pole}), error);
}

PhysicalNumbers withDraws(const Estimate& estimate) {
  const PlantDistribution plants(estimate);
  return physicalNumbers(estimate, &plants);
}

TEST(PhysicalNumbers, OfAFirstOrderPlant) {
  const PhysicalNumbers found = physicalNumbers(firstOrder(), nullptr);
  EXPECT_NEAR(numberOf(found, "gain").value, 8.2, 1e-9);
  EXPECT_NEAR(numberOf(found, "time_constant").value, 2, 1e-9);
  EXPECT_EQ(numberOf(found, "time_constant").unit, "s");
  EXPECT_EQ(numberOf(found, "dead_time").value, 0);
  const double bandwidth = numberOf(found, "bandwidth").value,
               pole = std::exp(-kPlainSampleTime / 2);
  const std::complex<double> z = std::polar(1.0, bandwidth * kPlainSampleTime);
  EXPECT_NEAR(std::abs((1 - pole) / (1.0 - pole / z)), 1 / std::sqrt(2.0), 1e-9);
  EXPECT_EQ(found.sentence,
            "First-order plant: gain 8.2, time constant 2 s, no dead time, bandwidth 0.5 rad/s.");
  EXPECT_FALSE(numberOf(found, "gain").lower || numberOf(found, "gain").spread);
}

TEST(PhysicalNumbers, OfAResonanceAndARealPole) {
  const std::complex<double> s = 5.0 * std::complex<double>(-0.3, std::sqrt(1 - 0.09));
  const std::complex<double> z = std::exp(s * kPlainSampleTime);
  const double p = std::exp(-kPlainSampleTime / 0.5), two = -2 * z.real(), squared = std::norm(z);
  const PhysicalNumbers found =
      physicalNumbers(estimateWithoutErrorModel(
                          vectorOf({1.0}), vectorOf({two - p, squared - two * p, -squared * p})),
                      nullptr);
  EXPECT_NEAR(numberOf(found, "natural_frequency").value, 5, 1e-6);
  EXPECT_NEAR(numberOf(found, "damping").value, 0.3, 1e-6);
  EXPECT_NEAR(numberOf(found, "time_constant").value, 0.5, 1e-6);
  EXPECT_NE(found.sentence.find("Third-order plant: gain "), std::string::npos) << found.sentence;
  EXPECT_NE(found.sentence.find("natural frequency 5 rad/s with damping 0.3"), std::string::npos);
}

TEST(PhysicalNumbers, SlowerThanTheExperimentsIsAnIntegrator) {
  Estimate estimate = estimateWithoutErrorModel(vectorOf({0.3}), vectorOf({-0.99999}));
  estimate.experiments = {{"long", 100, {}, {}, 0}};
  const PhysicalNumbers found = physicalNumbers(estimate, nullptr);
  EXPECT_NEAR(numberOf(found, "velocity_gain").value, 3, 1e-9);
  EXPECT_EQ(find(found, "gain"), nullptr);
  EXPECT_EQ(find(found, "bandwidth"), nullptr);
  EXPECT_EQ(found.sentence,
            "First-order plant that integrates: velocity gain 3 1/s, no dead time.");
  estimate.experiments[0].samples = 100000;
  EXPECT_NEAR(numberOf(physicalNumbers(estimate, nullptr), "gain").value, 30000, 1e-3);
}

TEST(PhysicalNumbers, PolesBelowZeroAlternate) {
  const PhysicalNumbers found =
      physicalNumbers(estimateWithoutErrorModel(vectorOf({1.0}), vectorOf({0.5})), nullptr);
  EXPECT_EQ(numberOf(found, "alternating_pole").value, -0.5);
  EXPECT_EQ(find(found, "time_constant"), nullptr);
  EXPECT_EQ(found.sentence,
            "First-order plant: gain 0.667, pole that alternates at z = -0.5, no dead time.");
}

TEST(PhysicalNumbers, DeadTimeIsWhatExceedsTheHold) {
  Estimate estimate = firstOrder();
  estimate.nominal_model.delay = 3;
  EXPECT_NEAR(numberOf(physicalNumbers(estimate, nullptr), "dead_time").value, 0.2, 1e-12);
  estimate.nominal_model.parameters = {{"dead_time", "s", 0.05, 0.01, 0.01}};
  const PhysicalNumbers found = physicalNumbers(estimate, nullptr);
  EXPECT_NEAR(numberOf(found, "dead_time").value, 0.25, 1e-12);
  EXPECT_NEAR(numberOf(found, "dead_time").lower.value_or(0), 0.25 - 0.0196, 1e-6);
  EXPECT_NE(found.sentence.find("dead time 0.25 s"), std::string::npos);
}

/// A gain of 2 whose estimate has a standard deviation of 0.1.
TEST(PhysicalNumbers, IntervalsAreThoseOfTheEstimate) {
  const Estimate estimate = estimateWithoutErrorModel(vectorOf({2.0}), Eigen::VectorXd(0), 0.01);
  const PhysicalNumbers found = withDraws(estimate);
  EXPECT_NEAR(numberOf(found, "gain").lower.value_or(0), 2 - 0.196, 0.01);
  EXPECT_NEAR(numberOf(found, "gain").upper.value_or(0), 2 + 0.196, 0.01);
  EXPECT_FALSE(numberOf(found, "gain").spread);
  EXPECT_EQ(withDraws(estimate).numbers[0].lower, numberOf(found, "gain").lower);
}

TEST(PhysicalNumbers, PolesOfAnotherKindLeaveNoInterval) {
  const Estimate sure = estimateWithoutErrorModel(vectorOf({1.0}), vectorOf({-1.4, 0.4901}), 1e-12);
  EXPECT_TRUE(numberOf(withDraws(sure), "natural_frequency").lower);
  const Estimate unsure =
      estimateWithoutErrorModel(vectorOf({1.0}), vectorOf({-1.4, 0.4901}), 0.01);
  EXPECT_FALSE(numberOf(withDraws(unsure), "natural_frequency").lower);
  EXPECT_TRUE(numberOf(withDraws(unsure), "gain").lower);
}

/// One tap that scales the plant by 1 + xi, with a standard deviation of xi of 0.2.
TEST(PhysicalNumbers, FiltersInSeriesSpreadTheGain) {
  Estimate estimate = firstOrder();
  ErrorModelEstimate& error = estimate.error_model;
  error.options.taps = 1;
  error.options.constraint = Constraint::free;
  error.options.components = 1;
  error.T = Eigen::MatrixXd::Ones(1, 1);
  error.mixture = {{1.0}, {Eigen::VectorXd::Zero(1)}, {Eigen::MatrixXd::Constant(1, 1, 0.04)}};
  const PhysicalNumbers found = withDraws(estimate);
  EXPECT_NEAR(numberOf(found, "gain").spread.value_or(0), 0.2 * 8.2, 0.01 * 8.2);
  EXPECT_EQ(numberOf(found, "bandwidth").spread.value_or(1), 0) << "only rounding is left";
  EXPECT_FALSE(numberOf(found, "time_constant").spread) << "filters do not move poles";
  EXPECT_FALSE(numberOf(physicalNumbers(estimate, nullptr), "gain").spread);
}

TEST(PhysicalNumbers, ParametersThatVarySpreadThePoles) {
  Estimate estimate = firstOrder();
  NominalModelOptions& options = estimate.configuration.nominal_model;
  options.structure = Structure::continuous;
  options.time_constants = 1;
  options.dead_time = false;
  options.nc = options.nd = 0;
  estimate.nominal_model.structure = "continuous";
  estimate.nominal_model.parameters = {{"gain", "", 8.2, 0, 0}, {"tau1", "s", 2, 0, 0}};
  ErrorModelEstimate& error = estimate.error_model;
  error.options.basis = BasisKind::parameter_spread;
  error.options.parameters = {"tau1"};
  error.options.constraint = Constraint::free;
  error.T = Eigen::MatrixXd::Ones(1, 1);
  error.mixture = {{1.0}, {Eigen::VectorXd::Zero(1)}, {Eigen::MatrixXd::Constant(1, 1, 0.01)}};
  estimate.joint_covariance.resize(0, 0);
  const PhysicalNumbers found = withDraws(estimate);
  EXPECT_NEAR(numberOf(found, "time_constant").spread.value_or(0), 0.2, 0.002);
  EXPECT_EQ(numberOf(found, "gain").spread.value_or(1), 0);
  EXPECT_FALSE(numberOf(found, "gain").lower) << "the errors of the estimate are not known";
}

TEST(PhysicalNumbers, TwoIntegratorsGiveAnAccelerationGain) {
  Estimate estimate = estimateWithoutErrorModel(vectorOf({0.02}), vectorOf({-2 + 2e-9, 1 - 2e-9}));
  estimate.experiments = {{"long", 100, {}, {}, 0}};
  const PhysicalNumbers found = physicalNumbers(estimate, nullptr);
  EXPECT_NEAR(numberOf(found, "acceleration_gain").value, 2, 1e-6);
  EXPECT_EQ(found.sentence,
            "Second-order plant that integrates twice: acceleration gain 2 1/s^2, no dead time.");
}

TEST(PhysicalNumbers, SeveralTimeConstantsAreNumberedFromTheSlowest) {
  const double slow = std::exp(-kPlainSampleTime / 3), fast = std::exp(-kPlainSampleTime / 0.4);
  const PhysicalNumbers found = physicalNumbers(
      estimateWithoutErrorModel(vectorOf({0.01}), vectorOf({-slow - fast, slow * fast})), nullptr);
  EXPECT_NEAR(numberOf(found, "time_constant_1").value, 3, 1e-6);
  EXPECT_NEAR(numberOf(found, "time_constant_2").value, 0.4, 1e-6);
  EXPECT_EQ(find(found, "time_constant"), nullptr);
  EXPECT_NE(found.sentence.find("time constant 1 3 s, time constant 2 0.4 s"), std::string::npos);
}

TEST(PhysicalNumbers, WithoutPolesThePlantIsStatic) {
  const PhysicalNumbers found =
      physicalNumbers(estimateWithoutErrorModel(vectorOf({2.5}), Eigen::VectorXd(0)), nullptr);
  EXPECT_EQ(found.sentence, "Static plant: gain 2.5, no dead time.");
  EXPECT_EQ(find(found, "bandwidth"), nullptr) << "it never falls by 3 dB";
}

TEST(PhysicalNumbers, OfHighOrderSayTheOrder) {
  Eigen::VectorXd a = Eigen::VectorXd::Zero(4);
  a[3] = -0.5;  // poles at the fourth roots of 0.5: two real, one of them below 0, and a pair
  const PhysicalNumbers found =
      physicalNumbers(estimateWithoutErrorModel(vectorOf({1.0}), a), nullptr);
  EXPECT_EQ(found.sentence.rfind("Plant of order 4: gain 2, ", 0), 0u) << found.sentence;
  EXPECT_NEAR(numberOf(found, "alternating_pole").value, -std::pow(0.5, 0.25), 1e-9);
}

}  // namespace
}  // namespace uncertainty_identification
