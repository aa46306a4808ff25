#include "explanation/masked_samples.h"

#include <gtest/gtest.h>

#include <cmath>

#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

/// A sensor that reports once in so many samples what moves all the time.
Split heldFor(int samples) {
  Experiment experiment;
  experiment.id = "1";
  experiment.sample_time = 1;
  experiment.u = Eigen::VectorXd::Zero(1600);
  experiment.y.resize(1600);
  for (int k = 0; k < 1600; ++k) {
    experiment.u[k] = std::sin(0.05 * k);
    experiment.y[k] = k % samples == 0 ? 10 * std::sin(0.011 * k) : experiment.y[k - 1];
  }
  return {{experiment}, {experiment}, true};
}

/// What is left of 16 readings would be refused as too short a record.
TEST(MaskedSamples, ARecordOfFewReadingsIsKeptWithWhatItsSensorHeld) {
  Configuration configuration;
  Split data = heldFor(100);
  const auto spoilt = maskSpoilt({}, &configuration, &data);
  ASSERT_EQ(spoilt.size(), 1u);
  EXPECT_EQ(spoilt[0].trait, Trait::held_samples);
  EXPECT_EQ(data.train[0].validSamples(), 1600);
  EXPECT_EQ(withoutSpoiltSamples(configuration, heldFor(100)).train[0].validSamples(), 1600);
}

TEST(MaskedSamples, OtherwiseTheReadingsAreLeft) {
  Configuration configuration;
  Split data = heldFor(40);
  EXPECT_EQ(maskSpoilt({}, &configuration, &data).size(), 1u);
  EXPECT_LT(data.train[0].validSamples(), 100);
  EXPECT_LT(withoutSpoiltSamples(configuration, heldFor(40)).train[0].validSamples(), 100);
}

}  // namespace
}  // namespace uncertainty_identification
