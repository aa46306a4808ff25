// Checks of residuals: Example 1 with its true parameters passes all; if the data are spoilt in one
// way, the check for that fails.
#include "explanation/residual_checks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "explanation/feedback_check.h"
#include "support/fit_setup.h"

namespace uncertainty_identification {
namespace {

using Spoil = std::function<void(Experiment*)>;

struct Judged {
  Fit fit;
  FitData data;
};

Judged judgedWith(const Spoil& spoil) {
  test::RandomSystem system = test::example1(2, 30);
  for (Experiment& experiment : system.experiments) spoil(&experiment);
  FitData data = test::example1Data(system.experiments);
  Fit fit = test::fitOfTruth(system.truth, test::example1Configuration(), data);
  return {fit, data};
}

Check checkNamed(const std::string& name, const Spoil& spoil) {
  const Judged judged = judgedWith(spoil);
  for (const Check& check : checkResiduals(judged.fit, judged.data, ResidualLaw::gaussian))
    if (check.name == name) return check;
  ADD_FAILURE() << "no check " << name;
  return {};
}

/// The check of this name fails, and says where.
void expectFails(const std::string& name, const std::string& where, const Spoil& spoil) {
  const Check check = checkNamed(name, spoil);
  EXPECT_FALSE(check.passed) << name;
  EXPECT_LT(check.p_value, kCheckThreshold);
  EXPECT_NE(check.where.find(where), std::string::npos) << check.where;
}

TEST(Checks, PassAtTheTruth) {
  const Judged judged = judgedWith([](Experiment*) {});
  const auto checks = checkResiduals(judged.fit, judged.data, ResidualLaw::gaussian);
  EXPECT_EQ(checks.size(), 7u);
  for (const Check& check : checks) {
    EXPECT_TRUE(check.passed) << check.name;
    EXPECT_GT(check.p_value, 1e-3) << check.name;  // seven tests
    EXPECT_TRUE(check.where.empty());
  }
  EXPECT_TRUE(allPassed(checks));
  EXPECT_EQ(checkResiduals(judged.fit, judged.data, ResidualLaw::of_steps).size(), 3u)
      << "without those of the shape";
}

/// An input that is not recorded moves the output by steps: what follows them is large for a while.
/// The noise's own tails do not cluster.
TEST(Checks, LargeResidualsThatClusterAreNoHeavyTails) {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  const auto passes = [&](double in_bursts) {
    const Judged judged = judgedWith([&](Experiment* e) {
      for (int t = 0; t < e->samples(); ++t)
        if (t % 20 < 5) e->y[t] += in_bursts * normal(engine);
    });
    const auto checks = checkResiduals(judged.fit, judged.data, ResidualLaw::heavy_tails);
    EXPECT_EQ(checks.size(), 4u) << "without those of the shape";
    EXPECT_EQ(checks.back().name, "volatility");
    return checks.back().passed;
  };
  EXPECT_TRUE(passes(0));
  EXPECT_FALSE(passes(1));
}

TEST(Checks, SeeWhatIsWrongAndWhere) {
  expectFails("whiteness", "rad/s", [](Experiment* e) {
    for (int t = 0; t < e->samples(); ++t) e->y[t] += 0.3 * std::sin(1.5 * t);
  });
  expectFails("dependence on the input", " of the input 3 samples before", [](Experiment* e) {
    for (int t = 3; t < e->samples(); ++t) e->y[t] += 0.01 * std::pow(e->u[t - 3], 2);
  });
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  expectFails("variance over time", "from 70 s to 80 s", [&](Experiment* e) {
    for (int t = 70; t < 80; ++t) e->y[t] += 0.6 * normal(engine);
  });
  expectFails("volatility", "cluster", [&](Experiment* e) {
    for (int t = 0; t < e->samples(); t += 20)
      for (int k = t; k < t + 5; ++k) e->y[k] += 0.6 * normal(engine);
  });
  expectFails("tails", "too many", [&](Experiment* e) { e->y[40] += 3 * normal(engine); });
  expectFails("symmetry", "positive", [&](Experiment* e) { e->y[30] += 2; });
}

TEST(Checks, NameTheExperimentThatDiffers) {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  const std::string loud = test::example1(2, 30).experiments[11].id;
  const Check check = checkNamed("variance over experiments", [&](Experiment* e) {
    for (int t = 0; e->id == loud && t < e->samples(); ++t) e->y[t] += 0.5 * normal(engine);
  });
  EXPECT_FALSE(check.passed);
  EXPECT_EQ(check.where, "strongest in " + loud);
}

/// Makes u = r - 0.8 y(t-1) of the input; plant and noise of Example 1 are simulated with it. A
/// slow disturbance of the sensor is added to what is recorded.
void closeLoop(double disturbance, std::mt19937_64* engine, Experiment* e) {
  std::normal_distribution<double> normal;
  double x = 0, v = 0, w_before = 0, slow = 0;
  for (int t = 0; t < e->samples(); ++t) {
    if (t > 0) x = -0.5 * x + e->u[t - 1];
    const double w = std::sqrt(0.1) * normal(*engine);
    v = -0.8 * v + w + 0.1 * w_before;
    w_before = w;
    e->u[t] -= t > 0 ? 0.8 * (e->y[t - 1] - slow) : 0;
    slow = 0.99 * slow + disturbance * normal(*engine);
    e->y[t] = x + v + slow;
  }
}

TEST(Feedback, IsSeenInTheInputThatAnswersTheOutput) {
  const Judged open = judgedWith([](Experiment*) {});
  const FeedbackTest none = testFeedback(residualsOf(open.fit, open.data), open.data);
  EXPECT_GT(none.p_value, 1e-3);
  EXPECT_LT(none.share, 0.005);
  std::mt19937_64 engine(2);
  const Judged closed = judgedWith([&](Experiment* e) { closeLoop(0, &engine, e); });
  const FeedbackTest loop = testFeedback(residualsOf(closed.fit, closed.data), closed.data);
  EXPECT_LT(loop.p_value, 1e-4);
  EXPECT_GT(loop.share, 0.02) << "u answers w by -0.8 w, of variance 0.064, beside a reference";
}

// A sum of sines, some of them slow against the 15 samples of the predictor, and a
// characteristic with a cubic part, which the model lacks and the residuals hold.
TEST(Feedback, IsNotSeenInAnInputThatRepeatsItself) {
  int start = 0;
  const Judged open = judgedWith([&](Experiment* e) {
    start += 17;
    for (int t = 0; t < e->samples(); ++t) {
      const double before = e->u[t];
      e->u[t] = 3 * std::sin(0.7 * (t + start)) * std::sin(0.11 * (t + start)) +
                2 * std::sin(0.31 * (t + start));
      if (t + 1 < e->samples()) e->y[t + 1] += e->u[t] - before + 0.05 * std::pow(e->u[t], 3);
    }
  });
  EXPECT_GT(testFeedback(residualsOf(open.fit, open.data), open.data).p_value, 1e-4);
}

// What is slow in the residuals is larger than the noise that the loop answers to.
TEST(Feedback, IsSeenBehindASlowDisturbance) {
  std::mt19937_64 engine(2);
  const Judged closed = judgedWith([&](Experiment* e) { closeLoop(0.3, &engine, e); });
  EXPECT_LT(testFeedback(residualsOf(closed.fit, closed.data), closed.data).p_value, 1e-4);
  const Judged open = judgedWith([&](Experiment* e) {
    std::normal_distribution<double> normal;
    double slow = 0;
    for (int t = 0; t < e->samples(); ++t) e->y[t] += slow = 0.99 * slow + 0.3 * normal(engine);
  });
  EXPECT_GT(testFeedback(residualsOf(open.fit, open.data), open.data).p_value, 1e-3);
}

}  // namespace
}  // namespace uncertainty_identification
