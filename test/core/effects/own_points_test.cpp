// Effects whose random size the output is not linear in: what a chain makes of an experiment's own
// point, and how the point is found.
#include <gtest/gtest.h>

#include <cmath>

#include "support/core_setup.h"
#include "support/effect_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kRuns = 11;

/// 0.9 q^-1/(1 + a q^-1).
VectorXd plant(const VectorXd& u, double a) {
  VectorXd x = VectorXd::Zero(u.size());
  for (Index t = 1; t < u.size(); ++t) x[t] = -a * x[t - 1] + 0.9 * u[t - 1];
  return x;
}

/// a1 of experiment r; that of setup.at() is -0.6.
double own(int r) { return -0.6 * (1 + 0.04 * (r - 5)); }

/// Points of the model `of` at these values of a1, xi = 0.
MatrixXd pointsAt(const ExtendedModel& of, const VectorXd& parameters, std::size_t spread) {
  MatrixXd points = of.points(parameters, MatrixXd::Zero(of.regressors(), kRuns));
  for (int r = 0; r < kRuns; ++r) points(of.pointRow(spread), r) = own(r);
  return points;
}

/// The same point in each experiment: its error parameters, and the first effect's own.
MatrixXd alike(const ExtendedModel& of, const VectorXd& xi, double own_point) {
  MatrixXd points(of.regressors() + 1, kRuns);
  points.topRows(of.regressors()) = xi.replicate(1, kRuns);
  points.row(of.pointRow(0)).setConstant(own_point);
  return points;
}

TEST(ParameterSpread, AtItsPointIsThePlantOfThatParameter) {
  const test::EffectSetup setup;
  const auto model = setup.extended({{"sens_wiener", ""}, {"plant_parameter_spread", "a1"}});
  EXPECT_EQ(model->pointRow(0), -1);
  const VectorXd at = setup.at(test::vectorOf({0.1, -0.02, 0})).parameters;
  const auto about = model->about(pointsAt(*model, at, 1));
  const auto found = setup.simulated(*about, at);
  for (int r = 0; r < kRuns; ++r) {
    const auto i = static_cast<std::size_t>(r);
    const Eigen::ArrayXd x = plant(setup.experiments()[i].u, own(r)).array();
    const Eigen::ArrayXd expected = x + 0.1 * x.square() - 0.02 * x.cube();
    EXPECT_LT((found[i].array() - expected).abs().maxCoeff(), 1e-9) << r;
  }
}

/// The signal that the deviation from the point multiplies is the output's derivative to it.
TEST(ParameterSpread, SignalIsTheDerivativeBehindTheSensor) {
  constexpr double kStep = 1e-6;
  const test::EffectSetup setup;
  const auto model = setup.extended({{"sens_wiener", ""}, {"plant_parameter_spread", "a1"}});
  const VectorXd at = setup.at(test::vectorOf({0.1, -0.02, 0})).parameters;
  const MatrixXd points = pointsAt(*model, at, 1);
  MatrixXd moved = points;
  moved.row(model->pointRow(1)).array() += -0.6 * kStep;  // by kStep, relative to a1
  const MatrixXd none = MatrixXd::Zero(model->regressors(), kRuns);
  for (const Block& block : setup.blocks()) {
    const Chain chain = model->about(points)->simulated(block, at, none);
    const Chain there = model->about(moved)->simulated(block, at, none);
    ASSERT_EQ(chain.random.size(), 1u);
    const Signals expected = (there.expected() - chain.expected()) / kStep;
    EXPECT_LT((chain.random[0].z - expected).abs().maxCoeff(), 1e-4);
  }
}

/// Of the first-order plant of setup.at(): a1 = -0.6 = -exp(-1/tau), behind which b is scaled.
TEST(TimeConstantSpread, AtItsPointIsThePlantOfThatTimeConstantAndTheSameGain) {
  const test::EffectSetup setup;
  const auto model = setup.extended({{"plant_parameter_spread", "time_constant"}});
  const VectorXd at = setup.at(test::vectorOf({0})).parameters;
  const VectorXd no_error = VectorXd::Zero(model->regressors());
  for (const double c : {0.0, 0.3, -0.4}) {
    const double a1 = -std::pow(0.6, 1 / (1 + c));
    const auto found = setup.simulated(*model->about(alike(*model, no_error, c)), at);
    for (int r = 0; r < kRuns; ++r) {
      const auto i = static_cast<std::size_t>(r);
      const VectorXd expected = plant(setup.experiments()[i].u, a1) * (1 + a1) / (1 - 0.6);
      EXPECT_LT((found[i] - expected).cwiseAbs().maxCoeff(), 1e-9) << c << " " << r;
    }
  }
}

TEST(TimeConstantSpread, SignalIsTheDerivativeToIt) {
  constexpr double kStep = 1e-5, kPoint = 0.2;
  const test::EffectSetup setup;
  const auto model = setup.extended({{"plant_parameter_spread", "time_constant"}});
  const VectorXd at = setup.at(test::vectorOf({0})).parameters;
  const VectorXd no_error = VectorXd::Zero(model->regressors());
  const MatrixXd xi = no_error.replicate(1, kRuns);
  for (const Block& block : setup.blocks()) {
    const auto of = [&](double c) {
      return model->about(alike(*model, no_error, c))->simulated(block, at, xi);
    };
    const Chain chain = of(kPoint), there = of(kPoint + kStep), here = of(kPoint - kStep);
    ASSERT_EQ(chain.random.size(), 1u);
    const Signals expected = (there.expected() - here.expected()) / (2 * kStep);
    EXPECT_LT((chain.random[0].z - expected).abs().maxCoeff(), 1e-6 * expected.abs().maxCoeff());
  }
}

/// Experiments with an a1 and a bias of their own.
std::vector<Experiment> spreadAndBiased() {
  std::vector<Experiment> all = test::recordedForEffects();
  for (int r = 0; r < kRuns; ++r) {
    Experiment& of = all[static_cast<std::size_t>(r)];
    of.y = plant(of.u, own(r)).array() + 0.1 * (r - 3);
  }
  return all;
}

/// Whatever was named first: columns follow the physical order, points that of naming.
TEST(OwnPoints, AreFoundInTheData) {
  const test::EffectSetup setup(test::effectConfiguration(), spreadAndBiased());
  const std::pair<std::string, std::string> spread{"plant_parameter_spread", "a1"},
      bias{"sens_bias", "per_experiment"};
  for (const bool first : {true, false}) {
    const auto model = first ? setup.extended({spread, bias}) : setup.extended({bias, spread});
    const VectorXd at = setup.at(test::vectorOf({8, 8})).parameters;
    const MatrixXd none = MatrixXd::Zero(model->regressors(), kRuns);
    MatrixXd points = model->points(at, none);
    const Index row = model->pointRow(first ? 0 : 1);
    EXPECT_EQ(points.row(row), Eigen::RowVectorXd::Constant(kRuns, -0.6)) << "not yet";
    for (int round = 0; round < 6; ++round)
      points = model->about(points)->pointsOf(setup.blocks(), at, none);
    for (int r = 0; r < kRuns; ++r) EXPECT_NEAR(points(row, r), own(r), 1e-3) << r;
  }
}

TEST(OwnPoints, FollowTheirEffectIntoAnotherModel) {
  const test::EffectSetup setup;
  const auto model = setup.extended(
      {{"plant_parameter_spread", "b1"}, {"plant_parameter_spread", "a1"}, {"exp_clock", ""}});
  const VectorXd at = setup.at(test::vectorOf({0, 0, 0})).parameters;
  const auto about = model->about(pointsAt(*model, at, 1));
  const Effects& effects = model->effects();
  const auto fewer = about->with({effects[2], effects[1]});
  const MatrixXd points = fewer->points(setup.at(test::vectorOf({0, 0})).parameters,
                                        MatrixXd::Zero(fewer->regressors(), kRuns));
  for (int r = 0; r < kRuns; ++r) {
    EXPECT_EQ(points(fewer->pointRow(0), r), 0);
    EXPECT_EQ(points(fewer->pointRow(1), r), own(r));
  }
}

/// No experiment is given a plant that runs away.
TEST(ParameterSpread, GoesNoFurtherThanThePlantIsStable) {
  const test::EffectSetup setup;
  const auto effect = findEffect(setup.all(), "plant_parameter_spread", "a1");
  const VectorXd theta = setup.at().parameters.head(4);
  const NominalModel& nominal = setup.linear().nominal();
  EXPECT_DOUBLE_EQ(effect->pointAt(0.5, nominal, theta), -0.9);
  EXPECT_DOUBLE_EQ(effect->pointAt(1, nominal, theta), -0.9) << "-1.2 is unstable";
  EXPECT_EQ(effect->pointAt(1e9, nominal, theta), -0.6);
}

}  // namespace
}  // namespace uncertainty_identification
