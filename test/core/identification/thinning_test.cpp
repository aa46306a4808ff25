// Records that are sampled far faster than the output moves. The plant is simulated here, exactly.
#include "data/thinning.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "uncertainty_identification/bounds/simulated_runs.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

constexpr double kFastPeriod = 0.00025, kFastGain = 2, kFastTau = 0.2,
                 kFastNoise = 0.002;  // [s], [-], [s], [-]
constexpr int kSamples = 20000;

/// A first-order lag; its input are steps behind an actuator of 50 ms.
Experiment oversampled(int seed) {
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  std::normal_distribution<double> normal;
  Experiment experiment;
  experiment.id = "run_" + std::to_string(seed);
  experiment.sample_time = kFastPeriod;
  experiment.u.resize(kSamples);
  experiment.y.resize(kSamples);
  const double pole = std::exp(-kFastPeriod / kFastTau), actuator = std::exp(-kFastPeriod / 0.05);
  double x = 0, u = 0, level = 0;
  for (int k = 0; k < kSamples; ++k) {
    if (k % 1200 == 0) level = normal(random);
    experiment.u[k] = u;
    experiment.y[k] = x + kFastNoise * normal(random);
    x = pole * x + kFastGain * (1 - pole) * u;
    u = actuator * u + (1 - actuator) * level;
  }
  return experiment;
}

class Thinning : public testing::Test {
 protected:
  Thinning() {
    automatic_.nominal_model.orders_auto = true;
    automatic_.bounds.folds = 2;
    stated_.nominal_model.orders_auto = false;
    stated_.nominal_model.nb = stated_.nominal_model.na = 1;
    stated_.nominal_model.nd = 0;
    stated_.error_model.taps = 0;
  }

  static Estimate identified(const Configuration& configuration,
                             const std::vector<Experiment>& experiments,
                             const std::vector<Experiment>& validation = {}) {
    return Identifier(configuration).identify(experiments, validation);
  }

  const std::vector<Experiment> data_{oversampled(1), oversampled(2)};
  Configuration automatic_, stated_;
};

TEST_F(Thinning, FollowsTheBandwidthWhereTheOrdersDo) {
  const Estimate estimate = identified(automatic_, data_, {oversampled(3)});
  const int thinning = estimate.configuration.estimation.thinning;
  EXPECT_GE(thinning, 5);
  EXPECT_LE(thinning, 16) << "2,500 samples of 40,000 are left";
  const NominalModelEstimate& model = estimate.nominal_model;
  EXPECT_DOUBLE_EQ(model.sample_time, thinning * kFastPeriod);
  EXPECT_NEAR(model.b.sum() / (1 + model.a.sum()), kFastGain, 0.005);
  EXPECT_GT(estimate.validation.simulation_fit_percent_pooled, 98);
}

TEST_F(Thinning, GivesWhatThinnedRecordsGive) {
  stated_.estimation.thinning = 10;
  const Estimate of_all = identified(stated_, data_, {oversampled(3)});
  Configuration plain = stated_;
  plain.estimation.thinning = 1;
  const Estimate of_thinned =
      identified(plain, thinned(data_, 10), thinned(std::vector<Experiment>{oversampled(3)}, 10));
  EXPECT_EQ(of_all.data_fingerprint, of_thinned.data_fingerprint);
  EXPECT_EQ(of_all.log_likelihood, of_thinned.log_likelihood);
  EXPECT_EQ(of_all.validation.simulation_fit_percent_pooled,
            of_thinned.validation.simulation_fit_percent_pooled);
  EXPECT_NEAR(of_all.nominal_model.a[0], -std::exp(-10 * kFastPeriod / kFastTau), 1e-3);
}

TEST_F(Thinning, IsLeftToWhoStatesOrdersOrASampleTime) {
  EXPECT_EQ(identified(stated_, data_).configuration.estimation.thinning, 1);
  automatic_.sample_time = kFastPeriod;
  automatic_.nominal_model.max_order = 1;
  EXPECT_EQ(identified(automatic_, data_).configuration.estimation.thinning, 1);
}

TEST_F(Thinning, HoldsForWhatFollows) {
  stated_.estimation.thinning = 10;
  stated_.bounds.folds = 2;
  const Estimate estimate = identified(stated_, data_);
  const Estimate again = Identifier(stated_).reidentify(estimate, data_);
  EXPECT_EQ(again.data_fingerprint, estimate.data_fingerprint);
  EXPECT_EQ(again.configuration.estimation.thinning, 10);
  const PredictionCalibration calibration = Identifier(stated_).calibrate(estimate, data_);
  ASSERT_EQ(calibration.scores.size(), 2u);
  for (const double score : calibration.scores) EXPECT_LT(score, 6 * kFastNoise);
  const auto runs = simulatedRuns(estimate, &calibration, data_, {});
  ASSERT_FALSE(runs.empty());
  EXPECT_GT(runs.front().fit_percent, 98);
}

}  // namespace
}  // namespace uncertainty_identification
