#include "explanation/undamped_poles.h"

#include <gtest/gtest.h>

#include <cmath>

namespace uncertainty_identification {
namespace {

constexpr double kSampleTime = 0.01, kLength = 1000, kFrequency = 60;  // [rad/s]

Cause at(const std::string& name, double frequency) {
  Cause cause;
  cause.name = name;
  cause.parameters = {{"amplitude", "", 1, 0, 1, 1}, {"frequency", "rad/s", frequency, 0, 0, 0}};
  return cause;
}

Eigen::VectorXd pairOf(double radius) {
  return Eigen::Vector2d(-2 * radius * std::cos(kFrequency * kSampleTime), radius * radius);
}

bool isHeld(const Cause& cause, double radius_of_plant, double radius_of_noise) {
  NominalModelEstimate model;
  model.sample_time = kSampleTime;
  model.a = pairOf(radius_of_plant);
  model.d = pairOf(radius_of_noise);
  return hasLineAsPoles({cause}, model, kLength);
}

TEST(HasLineAsPoles, OfPlantOrNoiseThatHardlyDecayWithinAnExperiment) {
  const Cause hum = at("sens_hum", kFrequency);
  EXPECT_TRUE(isHeld(hum, 0.9999, 0.5));
  EXPECT_TRUE(isHeld(hum, 0.5, 0.9999));
  EXPECT_FALSE(isHeld(hum, 0.999, 0.999)) << "1,000 samples to decay, of 1,000";
}

TEST(UndampedFrequency, IsOfPlantOrNoiseByThreePeriods) {
  NominalModelEstimate model;
  model.sample_time = kSampleTime;
  EXPECT_EQ(undampedFrequency(model, kLength), 0);
  model.d = pairOf(0.99995);
  EXPECT_NEAR(undampedFrequency(model, kLength), kFrequency * kSampleTime, 1e-9);
  EXPECT_EQ(undampedFrequency(model, 30), 0) << "2.9 periods";
  model.d = pairOf(0.9998);
  EXPECT_EQ(undampedFrequency(model, kLength), 0) << "loses 18 %";
}

TEST(HasUndampedPoles, LosesLessThanTheShare) {
  NominalModelEstimate model;
  model.a = pairOf(0.99995);  // loses 5 %
  const double frequency = kFrequency * kSampleTime;
  EXPECT_TRUE(hasUndampedPoles(model, frequency, kLength, 0.1));
  EXPECT_FALSE(hasUndampedPoles(model, frequency, kLength, 0.03));
}

TEST(NeverDecays, IsOfAnOscillationThatLosesLessThanATenthInAnExperiment) {
  const auto decays = [](const Eigen::VectorXd& a) {
    NominalModelEstimate plant;
    plant.a = a;
    return !neverDecays(plant, kLength);
  };
  EXPECT_FALSE(decays(pairOf(0.99995))) << "5 % in 1,000 samples";
  EXPECT_TRUE(decays(pairOf(0.9995))) << "40 %";
  EXPECT_TRUE(decays(Eigen::VectorXd::Constant(1, -1))) << "an integrator";
  EXPECT_TRUE(decays(Eigen::Vector2d(-1.9999, 0.9999))) << "and a slow pole";
  EXPECT_TRUE(decays({}));
}

TEST(HasLineAsPoles, OfThatFrequency) {
  EXPECT_TRUE(isHeld(at("sens_hum", kFrequency + 0.3), 0.9999, 0.5)) << "half of the resolution";
  EXPECT_FALSE(isHeld(at("sens_hum", kFrequency + 3), 0.9999, 0.5));
}

TEST(HasLineAsPoles, IsAskedOfLinesOnly) {
  EXPECT_FALSE(isHeld(at("plant_resonance", kFrequency), 0.9999, 0.9999));
  EXPECT_FALSE(hasLineAsPoles({}, {}, kLength));
  NominalModelEstimate static_gain;
  static_gain.sample_time = kSampleTime;
  EXPECT_FALSE(hasLineAsPoles({at("sens_hum", kFrequency)}, static_gain, kLength));
}

}  // namespace
}  // namespace uncertainty_identification
