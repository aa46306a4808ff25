// Oscillations of Go that no experiment sees decay. Data: single records, simulated here.
#include "identification/lasting_oscillations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <random>

#include "identification/identify.h"
#include "identification/steps.h"
#include "math/polynomial.h"
#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

using test::vectorOf;

/// 600 samples of a plant of second order, driven by white noise.
Experiment recordOf(double a1, double a2, double b, const std::function<double(int)>& disturbance) {
  Experiment record;
  record.id = "record";
  record.sample_time = 1;
  record.u = record.y = Eigen::VectorXd::Zero(600);
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (int k = 0; k < record.u.size(); ++k) record.u[k] = normal(random);
  for (int k = 2; k < record.u.size(); ++k)
    record.y[k] = -a1 * record.y[k - 1] - a2 * record.y[k - 2] + b * record.u[k - 1];
  for (int k = 0; k < record.u.size(); ++k) record.y[k] += disturbance(k) + 0.05 * normal(random);
  return record;
}

double quiet(int) { return 0; }
double hum(int k) { return 1.5 * std::sin(0.5 * k + 1); }

constexpr double kRadius = 0.998, kAngle = 0.3;  // left after 600 samples: 30 %
const double kA1 = -2 * kRadius * std::cos(kAngle), kA2 = kRadius * kRadius;

TEST(HasUnexcitedOscillation, NotWhereTheInputExcitesIt) {
  const Polynomials plant{1, vectorOf({0.1}), vectorOf({kA1, kA2}), {}, {}};
  EXPECT_FALSE(hasUnexcitedOscillation(plant, 0, {recordOf(kA1, kA2, 0.1, quiet)}));
}

/// The mode is cancelled by zeros, so that nothing but the disturbance can drive it.
TEST(HasUnexcitedOscillation, WhereItFollowsADisturbance) {
  const Eigen::VectorXd mode = vectorOf({1, -2 * std::cos(0.5), 1});
  const Eigen::VectorXd a = product(vectorOf({1, -0.9}), mode).tail(3);
  const Polynomials plant{1, 0.5 * mode, a, {}, {}};
  EXPECT_TRUE(hasUnexcitedOscillation(plant, 0, {recordOf(-0.9, 0, 0.5, hum)}));
  const Polynomials without{1, vectorOf({0.5}), vectorOf({-0.9}), {}, {}};
  EXPECT_FALSE(hasUnexcitedOscillation(without, 0, {recordOf(-0.9, 0, 0.5, hum)}));
}

/// A disturbance that oscillates throughout one record looks like the free response of a mode that
/// never decays, and would be simulated as such.
TEST(OrdersOfAPlant, DoNotIncludeADisturbanceThatOscillates) {
  const Estimate estimate = identify({}, {recordOf(-0.9, 0, 0.5, hum)}, {});
  for (const std::complex<double>& root : listOfRoots(estimate.nominal_model.a))
    EXPECT_TRUE(root.imag() == 0 || std::abs(root) < 0.995) << root;
  EXPECT_NEAR(estimate.nominal_model.b.sum() / (1 + estimate.nominal_model.a.sum()), 5, 0.5);
}

/// Without its oscillation the plant would simulate held-out data far worse.
TEST(OrdersOfAPlant, IncludeAnOscillationThatTheInputExcites) {
  Journal journal{ProgressPhases({})};
  const CheckedData data = checkData({}, {recordOf(kA1, kA2, 0.1, quiet)}, &journal);
  Problem problem{data, {}, nullptr, {}, {}, {}};
  problem.configuration = chooseInitialState(problem.configuration, data, &journal);
  problem.configuration.estimation.offsets = Offsets::estimate;
  choosePlant(&problem, &journal);
  ASSERT_TRUE(problem.plant.has_value());
  const Eigen::VectorXd& a = problem.plant->polynomials.a;
  ASSERT_EQ(a.size(), 2);
  EXPECT_NEAR(a[0], kA1, 1e-3);
  EXPECT_NEAR(a[1], kA2, 1e-3);
}

}  // namespace
}  // namespace uncertainty_identification
