#include "curves/free_simulation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace uncertainty_identification {
namespace {

constexpr int kLength = 60;

SimulationWindow slowWaves() {
  SimulationWindow window;
  window.u.resize(kLength);
  window.y.resize(kLength);
  for (int k = 0; k < kLength; ++k) {
    window.u[k] = std::sin(0.31 * k) + 0.6 * std::sin(0.113 * k + 1);
    window.y[k] = 1.3 * std::sin(0.2 * k + 0.5);
  }
  window.plays = playsOf(window.u);
  window.measured = Eigen::ArrayXd::Ones(kLength);
  window.time = Eigen::VectorXd::LinSpaced(kLength, 0, 1);
  window.covariates["heat"] = window.y.reverse();
  return window;
}

/// A plant of the second order with a direct term and a free curve, or a width, at a place.
CurveModel plantWith(Place place, const SimulationWindow& window) {
  CurveModel model;
  model.order = 2;
  model.direct = true;
  model.delay = 1;
  const bool reads_covariate = place == Place::covariate || place == Place::covariate_gain;
  const bool reads_time = place == Place::time || place == Place::time_gain;
  if (isScalar(place))
    model.curves.emplace_back(place);
  else
    model.curves.emplace_back(place, nullptr, reads_time ? window.time : window.y, 0.1,
                              reads_covariate ? "heat" : "");
  const int own = model.curves.back().parameters();
  model.theta.resize(6 + own);
  model.theta.head(6) << -1.2, 0.45, 0.3, 0.2, 0.1, 0.05;
  for (int k = 0; k < own; ++k) model.theta[6 + k] = isScalar(place) ? 0.2 : 0.05 * std::cos(k);
  model.rate_scale = 0.2;
  return model;
}

Eigen::VectorXd simulated(const CurveModel& model, const SimulationWindow& window,
                          const Eigen::VectorXd& initial) {
  return simulateFreely(model, tablesOf(model), window, initial, false).y;
}

class FreeSimulations : public testing::TestWithParam<int> {};

/// The table is piecewise linear, so that a step across one of its points departs by the change of
/// slope there; a few samples in a hundred may.
TEST_P(FreeSimulations, DerivativesAreThoseOfTheOutput) {
  constexpr double kStep = 1e-6;
  const auto place = static_cast<Place>(GetParam());
  const SimulationWindow window = slowWaves();
  const CurveModel model = plantWith(place, window);
  const Eigen::Vector2d initial(0.3, -0.2);
  const Eigen::MatrixXd exact =
      simulateFreely(model, tablesOf(model), window, initial, true).derivatives;
  for (int p = 0; p < model.parameters() + 2; ++p) {
    CurveModel above = model, below = model;
    Eigen::Vector2d high = initial, low = initial;
    if (p < model.parameters()) {
      above.theta[p] += kStep;
      below.theta[p] -= kStep;
    } else {
      high[p - model.parameters()] += kStep;
      low[p - model.parameters()] -= kStep;
    }
    const Eigen::VectorXd numeric =
        (simulated(above, window, high) - simulated(below, window, low)) / (2 * kStep);
    const Eigen::VectorXd own = exact.row(p).transpose();
    const double size = own.cwiseAbs().maxCoeff();
    ASSERT_GT(size, 1e-6) << nameOf(place) << ", parameter " << p;
    EXPECT_LT((numeric - own).norm(), 0.02 * own.norm()) << nameOf(place) << ", parameter " << p;
  }
}

INSTANTIATE_TEST_SUITE_P(OfEachPlace, FreeSimulations, testing::Range(0, 18));

TEST(FreeSimulation, OfALinearPlantIsItsDifferenceEquation) {
  const SimulationWindow window = slowWaves();
  CurveModel model;
  model.order = 1;
  model.theta = Eigen::Vector3d(-0.8, 0.5, 0.1);
  const Eigen::VectorXd y = simulated(model, window, Eigen::VectorXd::Constant(1, 0.7));
  double expected = 0.7;
  for (int k = 0; k < kLength; ++k) {
    EXPECT_NEAR(y[k], expected, 1e-12);
    expected = 0.8 * expected + 0.5 * (window.u[k] + 0.1);
  }
}

/// A plant without curves is simulated in another way than one with a curve, here of zeros.
TEST(FreeSimulation, OfALinearPlantIsThatWithACurveOfZeros) {
  SimulationWindow window = slowWaves();
  window.y = window.u;
  for (const bool direct : {false, true}) {
    CurveModel linear;
    linear.order = 3;
    linear.delay = 2;
    linear.direct = direct;
    linear.own_level = true;
    linear.rate_scale = 0.3;
    linear.theta.resize(linear.linearParameters());
    linear.theta.head(3) = Eigen::Vector3d(-1.9, 1.2, -0.22);
    linear.theta.segment(3, 3) = Eigen::Vector3d(0.3, -0.1, 0.05);
    if (direct) linear.theta[6] = 0.4;
    linear.theta[linear.biasIndex()] = 0.7;
    CurveModel with_curve = linear;
    with_curve.curves.push_back(plantWith(Place::time, window).curves.front());
    const int parameters = linear.parameters();
    with_curve.theta.conservativeResize(parameters + with_curve.curves.front().parameters());
    with_curve.theta.tail(with_curve.theta.size() - parameters).setZero();
    const Eigen::Vector4d initial(0.3, -0.2, 0.1, 1.5);
    const FreeSimulation made = simulateFreely(linear, {}, window, initial, true);
    const FreeSimulation expected =
        simulateFreely(with_curve, tablesOf(with_curve), window, initial, true);
    EXPECT_NEAR((made.y - expected.y).cwiseAbs().maxCoeff(), 0, 1e-12);
    EXPECT_NEAR((made.rate - expected.rate).cwiseAbs().maxCoeff(), 0, 1e-12);
    ASSERT_EQ(made.derivatives.rows(), parameters + 4);
    EXPECT_NEAR((made.derivatives.topRows(parameters) - expected.derivatives.topRows(parameters))
                    .cwiseAbs()
                    .maxCoeff(),
                0, 1e-10);
    EXPECT_NEAR(
        (made.derivatives.bottomRows(4) - expected.derivatives.bottomRows(4)).cwiseAbs().maxCoeff(),
        0, 1e-10);
  }
}

/// A state that diverges is held, as it is where a curve may bend it back.
TEST(FreeSimulation, OfAnUnstablePlantHoldsItsState) {
  SimulationWindow window = slowWaves();
  CurveModel model;
  model.order = 1;
  model.theta = Eigen::Vector3d(-1.2, 0.5, 0.1);
  const Eigen::VectorXd y = simulated(model, window, Eigen::VectorXd::Constant(1, 1));
  EXPECT_EQ(y.cwiseAbs().maxCoeff(), kLargestState);
}

TEST(FreeSimulation, PlayHoldsTheOutputWithinItsWidth) {
  SimulationWindow window = slowWaves();
  CurveModel model;
  model.order = 1;
  model.direct = true;  // y = w
  model.curves.emplace_back(Place::play);
  model.theta.resize(5);
  model.theta << 0, 0, 1, 0, 0.5;
  const Eigen::VectorXd y = simulated(model, window, Eigen::VectorXd::Zero(1));
  for (int k = 1; k < kLength; ++k) {
    EXPECT_LE(std::abs(y[k] - window.u[k]), 0.5 + 1e-5);
    if (std::abs(y[k - 1] - window.u[k]) < 0.49) {
      EXPECT_EQ(y[k], y[k - 1]);
    }
  }
}

/// A level is added to the output, and acts on nothing else.
TEST(FreeSimulation, CountsFromALevelOfTheWindow) {
  const SimulationWindow window = slowWaves();
  CurveModel model = plantWith(Place::input, window);
  const Eigen::Vector2d state(0.3, -0.2);
  const Eigen::VectorXd without = simulated(model, window, state);
  const Eigen::MatrixXd derivatives =
      simulateFreely(model, tablesOf(model), window, state, true).derivatives;
  model.own_level = true;
  const Eigen::Vector3d initial(0.3, -0.2, 1.7);
  EXPECT_NEAR((simulated(model, window, initial).array() - without.array() - 1.7).abs().maxCoeff(),
              0, 1e-12);
  const Eigen::MatrixXd with =
      simulateFreely(model, tablesOf(model), window, initial, true).derivatives;
  ASSERT_EQ(with.rows(), derivatives.rows() + 1);
  EXPECT_NEAR((with.topRows(derivatives.rows()) - derivatives).cwiseAbs().maxCoeff(), 0, 1e-12);
  EXPECT_TRUE((with.bottomRows(1).array() == 1).all());
}

}  // namespace
}  // namespace uncertainty_identification
