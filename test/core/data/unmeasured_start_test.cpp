// Experiments whose first outputs were not measured.
#include "data/unmeasured_start.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/mentions.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

TEST(UnmeasuredStart, IsLeftOut) {
  Experiment late;
  late.id = "late";
  late.sample_time = 0.5;
  late.start_time = 10;
  late.u = late.y = late.signals["wind"] = Eigen::VectorXd::LinSpaced(6, 0, 5);
  late.valid = {0, 0, 1, 0, 1, 1};
  Experiment whole = late;
  whole.valid = {1, 0, 1, 0, 1, 1};
  Experiment never = late;
  never.valid.assign(6, 0);
  std::vector<std::string> remarks;
  const auto kept = fromFirstMeasured({late, whole, never}, &remarks);
  EXPECT_EQ(kept[0].u, Eigen::VectorXd::LinSpaced(4, 2, 5));
  EXPECT_EQ(kept[0].y, kept[0].u);
  EXPECT_EQ(kept[0].signals.at("wind"), kept[0].u);
  EXPECT_EQ(kept[0].valid, (std::vector<std::uint8_t>{1, 0, 1, 1}));
  EXPECT_EQ(kept[0].start_time, 11);
  EXPECT_EQ(kept[1].samples(), 6);
  EXPECT_EQ(kept[2].samples(), 6);
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_TRUE(test::mentions(
      remarks[0], "1 of 3 experiments are used from their first measured output on; up to 2 "));
}

/// A plant of first order far from rest, with little noise, read in steps of 1/16, whose sensor is
/// silent for the first `late` samples.
Experiment lateSensor(int late) {
  constexpr int kSamples = 430;
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  Experiment experiment;
  experiment.id = "late";
  experiment.sample_time = 0.8;
  experiment.u = experiment.y = Eigen::VectorXd::Zero(kSamples);
  experiment.valid.assign(kSamples, 1);
  std::fill(experiment.valid.begin(), experiment.valid.begin() + late, std::uint8_t{0});
  double x = 1.2 * 24.6 + 10, before = x, level = 24.6;
  for (int k = 0; k < kSamples; ++k) {
    if (k % 40 == 0) level = random() % 2 == 0 ? 24.6 : 20.6;
    experiment.u(k) = level;
    experiment.y(k) = std::round(16 * (40 + before + 0.02 * normal(random))) / 16;
    before = x;
    x += 0.003 * (1.2 * level - x);
  }
  return experiment;
}

/// Log-likelihood at the true plant, of which `poles` beyond the first are cancelled by zeros.
double logLikelihood(const Experiment& experiment, const std::vector<double>& poles) {
  Configuration configuration;
  NominalModelOptions& nominal = configuration.nominal_model;
  nominal.orders_auto = false;
  nominal.structure = Structure::output_error;
  nominal.nb = nominal.na = 1 + static_cast<int>(poles.size());
  nominal.nc = nominal.nd = 0;
  nominal.delay = 2;
  Eigen::VectorXd b = Eigen::VectorXd::Constant(1, 0.003 * 1.2),
                  a = Eigen::Vector2d(1, -0.997);  // with its leading 1
  for (const double pole : poles) {
    const auto times = [pole](const Eigen::VectorXd& of) {
      Eigen::VectorXd product = Eigen::VectorXd::Zero(of.size() + 1);
      product.head(of.size()) = of;
      product.tail(of.size()) -= pole * of;
      return product;
    };
    b = times(b);
    a = times(a);
  }
  configuration.initial.theta.resize(b.size() + a.size() - 1);
  configuration.initial.theta << b, a.tail(a.size() - 1);
  configuration.initial.noise_variance = 0.02 * 0.02 + 1.0 / 16 / 16 / 12;
  configuration.estimation.initial_state = InitialState::estimate;
  configuration.estimation.max_iterations = 0;
  return Identifier(configuration).identify({experiment}).log_likelihood;
}

// Surplus poles that zeros cancel change the likelihood by the priors of their initial values
// alone, each some nats. In sums over all samples no digit of the small residuals is right beside
// directions of the state that no output shows: off by hundreds of nats.
TEST(UnmeasuredStart, SurplusPolesThatNoOutputShowsCostSomeNats) {
  constexpr double kPrior = 10;  // [nats] of an initial value with a wide prior
  for (const int late : {0, 1, 10, 40, 150}) {
    const double without = logLikelihood(lateSensor(late), {});
    EXPECT_NEAR(logLikelihood(lateSensor(late), {0.96, -0.375}), without, 2 * kPrior) << late;
  }
}

}  // namespace
}  // namespace uncertainty_identification
