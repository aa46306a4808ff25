#include "curves/window_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "curves/fit_comparison.h"
#include "curves/held_out.h"
#include "curves/initial_states.h"
#include "curves/starts.h"
#include "support/first_order_windows.h"

namespace uncertainty_identification {
namespace {

/// `data` without one window.
SimulationData without(const SimulationData& data, std::size_t left_out) {
  SimulationData rest = data;
  rest.windows.erase(rest.windows.begin() + static_cast<std::ptrdiff_t>(left_out));
  rest.groups.pop_back();
  rest.samples -= data.longest;
  return rest;
}

TEST(WindowFit, FindsThePlantAndEachWindowsInitialState) {
  const SimulationData data = firstOrderWindows(20, 100, 0.1, 1);
  const WindowFit fit = fitted(data);
  for (const auto& [index, truth] : {std::pair{0, -kPole}, {1, kGain}, {2, 0.0}}) {
    const double error = std::sqrt(fit.covariance(index, index));
    EXPECT_GT(error, 1e-4);
    EXPECT_NEAR(fit.model.theta[index], truth, 4 * error);  // one in 16,000 by chance
  }
  // 0.01 a sample, less one in a hundred for each initial state and the three parameters.
  EXPECT_NEAR(fit.squared_error, 0.01 * (data.samples - 20 - 3),
              4 * 0.01 * std::sqrt(2.0 * data.samples));
  EXPECT_NEAR(effectiveSamples(fit), data.samples, 0.2 * data.samples);
}

/// What is left out is the error of a fit to the other windows: here that fit is made.
TEST(WindowFit, LeavesEachWindowOutAsAFitWithoutItDoes) {
  const SimulationData data = firstOrderWindows(20, 60, 0.3, 2);
  const WindowFit fit = fitted(data);
  ASSERT_EQ(fit.left_out_of.size(), 20);
  for (const std::size_t w : {std::size_t{0}, std::size_t{7}, std::size_t{19}}) {
    WindowFit others = fitted(without(data, w));
    SimulationData alone = without(data, w);
    alone.windows = {data.windows[w]};
    alone.groups = {0, 1};
    alone.samples = data.longest;
    others.model.initial = initialStates(alone, others.model, data.longest);
    const double refitted = simulationError(alone, others.model);
    EXPECT_NEAR(fit.left_out_of[static_cast<Eigen::Index>(w)], refitted, 0.01 * refitted);
  }
  EXPECT_GT(fit.left_out, fit.squared_error);
}

TEST(WindowFit, DoesNotSeeWhatIsNotMeasured) {
  SimulationData data = firstOrderWindows(20, 60, 0.1, 3);
  const WindowFit before = fitted(data);
  for (SimulationWindow& window : data.windows) window.measured[30] = 0;
  SimulationData spoilt = data;
  for (SimulationWindow& window : spoilt.windows) window.y[30] = 50;
  CurveModel start = before.model;
  const WindowFit one = fitFreely(data, start, {}), other = fitFreely(spoilt, start, {});
  EXPECT_EQ(one.model.theta, other.model.theta);
  EXPECT_EQ(one.squared_error, other.squared_error);
}

TEST(WindowFit, UnseenWindowsAreThoseLeftOutAndThoseHeldOut) {
  const WindowFit fit = fitted(firstOrderWindows(20, 60, 0.1, 4));
  const SimulationData held = firstOrderWindows(9, 60, 0.1, 5);
  const Eigen::VectorXd unseen = unseenErrors(fit, held);
  ASSERT_EQ(unseen.size(), 29);
  EXPECT_EQ(unseen.head(20), fit.left_out_of);
  EXPECT_EQ(unseen.tail(9), heldOutErrors(held, fit.model));
}

TEST(WindowFit, PairedTComparesWindowByWindow) {
  const Eigen::VectorXd before = Eigen::Vector4d(4, 5, 6, 7);
  const Eigen::VectorXd after = Eigen::Vector4d(3, 4.5, 5, 6.5);
  // Differences 1, 0.5, 1, 0.5: mean 0.75, standard error 0.2887 / 2.
  const double of_differences = 0.75 / (std::sqrt(0.25 / 3) / 2);
  EXPECT_GE(pairedT(before, after), of_differences - 1e-6);
  EXPECT_LT(pairedT(after, before), 0);
}

TEST(LinearStart, FollowsTheDeadTime) {
  SimulationData data = firstOrderWindows(10, 100, 0.02, 4);
  for (SimulationWindow& window : data.windows)
    for (int k = 0; k + 3 < window.samples(); ++k) window.u[k] = window.u[k + 3];
  // The input now comes three samples before it acts.
  const CurveModel none = linearStart(data, 1, false, 0), three = linearStart(data, 1, false, 3);
  EXPECT_LT(simulationError(data, three), 0.2 * simulationError(data, none));
}

TEST(WithCancellingPair, SimulatesTheSame) {
  const SimulationData data = firstOrderWindows(3, 80, 0.1, 5);
  const WindowFit small = fitted(data);
  CurveModel large = withCancellingPair(small.model, 0.5);
  EXPECT_EQ(large.order, 2);
  large.initial = initialStates(data, large, data.longest);
  EXPECT_LT(simulationError(data, large), small.squared_error * 1.001);
}

}  // namespace
}  // namespace uncertainty_identification
