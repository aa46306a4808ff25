// Experiments that do not belong to the others. Data: first-order plants whose gains differ a
// little, simulated.
#include "identification/odd_experiments.h"

#include <gtest/gtest.h>

#include <random>

#include "support/mentions.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

constexpr int kCount = 10;

std::vector<Experiment> experiments() {
  constexpr int kSamples = 150;
  std::mt19937_64 engine(11);
  std::normal_distribution<double> normal;
  std::vector<Experiment> all(kCount);
  for (int r = 0; r < kCount; ++r) {
    Experiment& each = all[static_cast<std::size_t>(r)];
    each.id = "run_" + std::to_string(r);
    each.sample_time = 0.1;
    each.u.resize(kSamples);
    each.y.resize(kSamples);
    const double gain = 1 + 0.03 * normal(engine);
    double x = 0;
    for (int k = 0; k < kSamples; ++k) {
      each.u[k] = k % 7 == 0 ? normal(engine) : each.u[k - 1];
      each.y[k] = 4 + gain * x + 0.02 * normal(engine);
      x = 0.8 * x + 0.2 * each.u[k];
    }
  }
  return all;
}

Estimate identifiedFrom(const std::vector<Experiment>& all) {
  Configuration configuration;
  configuration.nominal_model.orders_auto = false;
  configuration.nominal_model.structure = Structure::output_error;
  return Identifier(configuration).identify(all);
}

std::string warningOf(const Estimate& estimate) {
  for (const std::string& warning : estimate.warnings)
    if (test::mentions(warning, "times what the mean plant simulates")) return warning;
  return "";
}

/// The experiments with the output of some of them about its zero point multiplied.
std::string warningWhere(double factor, int count) {
  std::vector<Experiment> all = experiments();
  for (int r = 0; r < count; ++r) {
    Eigen::VectorXd& y = all[static_cast<std::size_t>(3 * r)].y;
    y = (factor * (y.array() - 4) + 4).matrix();
  }
  return warningOf(identifiedFrom(all));
}

TEST(OddExperiments, AreOfAnotherRangeOrSign) {
  EXPECT_TRUE(test::mentions(warningWhere(2.2, 1), "experiment 'run_0'"));
  EXPECT_TRUE(test::mentions(warningWhere(0.1, 1), "experiment 'run_0'"));
  EXPECT_TRUE(test::mentions(warningWhere(-1, 1), "sign of the sensor"));
}

TEST(OddExperiments, AreFew) {
  EXPECT_EQ(warningWhere(1, 1), "");
  EXPECT_EQ(warningWhere(1.1, 1), "") << "differences of a tenth are not material";
  EXPECT_EQ(warningWhere(2.2, 3), "") << "another population, not an oddity";
}

/// Levels of their own, as of a machine that is run at another point each day.
TEST(OddExperiments, AreSeenAtAnyLevel) {
  std::vector<Experiment> all = experiments();
  for (std::size_t r = 0; r < all.size(); ++r) {
    if (r == 3) all[r].y = (0.4 * (all[r].y.array() - 4) + 4).matrix();
    all[r].y.array() += 10.0 * static_cast<double>(r * r % 7);
  }
  Configuration configuration;
  configuration.nominal_model.orders_auto = false;
  configuration.nominal_model.structure = Structure::output_error;
  configuration.estimation.offsets = Offsets::per_experiment;
  const Estimate estimate = Identifier(configuration).identify(all);
  EXPECT_TRUE(test::mentions(warningOf(estimate), "experiment 'run_3'"));
  EXPECT_TRUE(estimate.has_odd_experiments);
}

TEST(OddExperiments, AreToldOfFour) {
  std::vector<Experiment> all = experiments();
  all.resize(4);
  EXPECT_FALSE(identifiedFrom(all).has_odd_experiments);
  all[0].y = (0.1 * (all[0].y.array() - 4) + 4).matrix();
  EXPECT_TRUE(identifiedFrom(all).has_odd_experiments);
}

TEST(OddExperiments, FollowTheSimulation) {
  std::vector<Experiment> all = experiments();
  std::mt19937_64 engine(12);
  std::normal_distribution<double> normal;
  for (int k = 0; k < all[2].samples(); ++k) all[2].y[k] = 4 + 0.4 * normal(engine);
  EXPECT_EQ(warningOf(identifiedFrom(all)), "");
}

TEST(OddExperiments, AreToldWhereTheVariationIs) {
  std::vector<Experiment> all = experiments();
  EXPECT_FALSE(test::mentions(identifiedFrom(all).variation, "belong together"));
  all[5].y = 8 - all[5].y.array();  // the sign about the level of all
  EXPECT_TRUE(test::mentions(identifiedFrom(all).variation, "belong together"));
}

}  // namespace
}  // namespace uncertainty_identification
