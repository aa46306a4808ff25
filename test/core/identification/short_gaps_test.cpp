#include "identification/short_gaps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

/// A lag of pole 0.5 behind a fast input, a drift, and noise of this size.
Experiment fastLag(double noise, int seed = 1) {
  std::mt19937_64 engine(static_cast<std::uint64_t>(seed));
  std::normal_distribution<double> normal;
  Experiment experiment;
  experiment.id = std::to_string(seed);
  experiment.sample_time = 1;
  experiment.u.resize(300);
  experiment.y.resize(300);
  double x = 0;
  for (int k = 0; k < 300; ++k) {
    experiment.u[k] = normal(engine);
    experiment.y[k] = x + noise * normal(engine);
    x = 0.5 * x + experiment.u[k];
  }
  experiment.valid.assign(300, 1);
  return experiment;
}

void lose(int first, int count, Experiment* experiment) {
  for (int k = first; k < first + count; ++k) {
    experiment->valid[static_cast<std::size_t>(k)] = 0;
    experiment->y[k] = std::numeric_limits<double>::quiet_NaN();
  }
}

Experiment filled(const Experiment& experiment) {
  Polynomials plant;
  plant.b = Eigen::VectorXd::Constant(1, 1);
  plant.a = Eigen::VectorXd::Constant(1, -0.5);
  plant.delay = 1;
  return withShortGapsFilled({experiment}, plant, 0, {}).front();
}

/// By its neighbours alone, a fast output would not be known at all.
TEST(ShortGaps, AreFilledByThePlantAndTheDriftAroundThem) {
  const Experiment whole = fastLag(0);
  Experiment drifting = whole;
  drifting.y += Eigen::VectorXd::LinSpaced(300, 0, 3);
  Experiment gapped = drifting;
  lose(100, 2, &gapped);
  lose(200, 3, &gapped);
  const Experiment found = filled(gapped);
  EXPECT_TRUE(found.valid.empty());
  EXPECT_LT((found.y - drifting.y).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(ShortGaps, LongOnesAndThoseAtTheEndsStay) {
  Experiment gapped = fastLag(0.1);
  lose(0, 1, &gapped);
  lose(100, 4, &gapped);
  lose(200, 1, &gapped);
  lose(298, 2, &gapped);
  const Experiment found = filled(gapped);
  EXPECT_EQ(found.validSamples(), 293);
  EXPECT_TRUE(found.isValid(200));
}

TEST(ShortGaps, StayWhereMuchIsMissing) {
  Experiment gapped = fastLag(0.1);
  for (int k = 10; k < 290; k += 15) lose(k, 1, &gapped);
  EXPECT_EQ(filled(gapped).validSamples(), gapped.validSamples());
}

/// Structures are compared on as many samples as if none were missing; the model that is chosen is
/// fitted to those that were measured.
TEST(ShortGaps, AreFilledWhereStructuresAreCompared) {
  std::vector<Experiment> gapped;
  for (int seed = 1; seed <= 6; ++seed) {
    gapped.push_back(fastLag(0.05, seed));
    for (int k = 20; k < 290; k += 27) lose(k, 1, &gapped.back());
  }
  Configuration configuration;
  configuration.nominal_model.orders_auto = true;
  configuration.bounds.frequencies = 0;
  const Estimate estimate = Identifier(configuration).identify(gapped);
  EXPECT_EQ(estimate.sample_count, 6 * 290);
  double compared = 0;
  for (const Candidate& each : estimate.candidates)
    if (each.choice == "error model" && each.chosen) compared = each.log_likelihood.value_or(0);
  // Density of a sample: log(1/0.05) - 1.42. The 60 that were filled are more than 60 nats.
  EXPECT_GT(compared, estimate.log_likelihood + 60) << estimate.log_likelihood;
}

}  // namespace
}  // namespace uncertainty_identification
