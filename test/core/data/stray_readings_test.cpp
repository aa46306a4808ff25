#include "data/stray_readings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace uncertainty_identification {
namespace {

constexpr int kSamples = 1000;
constexpr double kMost = 0.05;
const std::vector<int> kWrong{100, 101 + 50, 400, 777, 995};

/// A slow lag behind levels of the input, with noise.
Experiment recorded(int levels = 40) {
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  Experiment experiment;
  experiment.id = "run";
  experiment.sample_time = 0.1;
  experiment.u.resize(kSamples);
  experiment.y.resize(kSamples);
  double x = 0, level = 0;
  for (int t = 0; t < kSamples; ++t) {
    if (t % levels == 0) level = normal(engine);
    experiment.u[t] = level;
    experiment.y[t] = x + 0.02 * normal(engine);
    x += 0.1 * (level - x);
  }
  return experiment;
}

Experiment withStray(const std::vector<int>& samples = kWrong, double size = 3) {
  Experiment experiment = recorded();
  for (const int t : samples) experiment.y[t] += t % 2 == 0 ? size : -size;
  return experiment;
}

TEST(StrayReadings, AreThoseThatLeaveBothNeighbours) {
  const StrayReadings found = strayReadings({recorded(), withStray()}, kMost);
  ASSERT_EQ(found.samples.size(), 2u);
  EXPECT_TRUE(found.samples[0].empty());
  EXPECT_EQ(found.samples[1], kWrong);
  EXPECT_EQ(found.count, 5);
  EXPECT_DOUBLE_EQ(found.share, 0.0025);
  EXPECT_NEAR(found.size, 3, 0.2);
}

TEST(StrayReadings, AreMarkedAsMissingAndTold) {
  const std::vector<Experiment> all{withStray()};
  const StrayReadings found = strayReadings(all, kMost);
  const std::vector<Experiment> cleaned = without(found, all);
  EXPECT_EQ(cleaned.front().validSamples(), kSamples - 5);
  for (const int t : kWrong) EXPECT_FALSE(cleaned.front().isValid(t));
  const std::string text = strayText(found, all);
  EXPECT_NE(text.find("5 single readings of the output (0.5 %) stray"), std::string::npos) << text;
  EXPECT_NE(text.find("at 10 s of experiment 'run'"), std::string::npos) << text;
  EXPECT_EQ(strayText(strayReadings({recorded()}, kMost), {recorded()}), "");
}

/// The neighbours of so many are a sixth of the samples.
TEST(StrayReadings, MayBeOneInThirty) {
  std::vector<int> wrong;
  for (int t = 10; t < 980; t += 30) wrong.push_back(t);
  EXPECT_EQ(strayReadings({withStray(wrong)}, kMost).samples.at(0), wrong);
}

/// A counter that overflows once.
TEST(StrayReadings, MayBeASingleOneFarBeyondAllOthers) {
  EXPECT_EQ(strayReadings({recorded(), withStray({420}, 1e4)}, kMost).samples.at(1),
            std::vector<int>{420});
  EXPECT_EQ(strayReadings({withStray({420}, 1e4), withStray({150}, 3)}, kMost).count, 1)
      << "the other one may be noise";
}

/// A plant that passes changes only answers a step, or a blow of a hammer, with a single reading.
TEST(StrayReadings, AreNoAnswersToASingleStep) {
  Experiment step;
  step.sample_time = 0.1;
  step.u = step.y = Eigen::VectorXd::Zero(400);
  step.u.tail(200).setOnes();
  for (int t = 0; t < 400; ++t) step.y[t] = 0.01 * std::sin(1.0 * t);
  step.y[201] = 1;
  EXPECT_EQ(strayReadings({step}, kMost).count, 0);
  step.y[201] = 0;
  step.y[320] = 1;
  EXPECT_EQ(strayReadings({step}, kMost).count, 1);
}

/// Each differs from the record with stray readings in one way.
TEST(StrayReadings, AreNotWhatElseLooksLikeThem) {
  const auto count = [](const Experiment& experiment) {
    return strayReadings({experiment}, kMost).count;
  };
  EXPECT_EQ(count(recorded()), 0);
  EXPECT_EQ(count(recorded(1)), 0) << "another level at each sample";
  EXPECT_EQ(count(withStray({100, 400})), 0) << "fewer than three";
  EXPECT_EQ(count(withStray(kWrong, 0.1)), 0) << "within the usual noise";
  EXPECT_EQ(count(withStray({100, 101, 400, 401, 700, 701, 900, 901})), 0) << "two that follow";
  Experiment answers = withStray();
  for (const int t : kWrong) answers.u[t - 2] += 20;
  EXPECT_EQ(count(answers), 0) << "answers to pulses of the input";
  Experiment missing = withStray();
  missing.valid.assign(kSamples, 1);
  for (const int t : kWrong) missing.valid[static_cast<std::size_t>(t)] = 0;
  EXPECT_EQ(count(missing), 0) << "not measured";
  EXPECT_EQ(strayReadings({withStray()}, 0.004).count, 0) << "more than are allowed";
}

/// A plant that passes changes only answers each step of its input with one sample.
TEST(StrayReadings, AreNotAnswersToSteps) {
  for (const int levels : {25, 60, 200}) {
    Experiment experiment = recorded(levels);
    for (int t = 1; t < kSamples; ++t)
      experiment.y[t] = experiment.u[t] - experiment.u[t - 1] + 1e-3 * std::sin(1e3 * t);
    EXPECT_EQ(strayReadings({experiment}, kMost).count, 0) << levels;
  }
}

TEST(StrayReadings, AreNotTheSmallestStepsOfASensor) {
  std::mt19937_64 engine(9);
  std::normal_distribution<double> normal;
  Experiment experiment = recorded();
  for (int t = 0; t < kSamples; ++t)
    experiment.y[t] = std::round(5 * std::sin(0.01 * t) + 0.1 * normal(engine));
  EXPECT_EQ(strayReadings({experiment}, kMost).count, 0);
  experiment.y.setZero();
  for (const int t : kWrong) experiment.y[t] = 1;
  EXPECT_EQ(strayReadings({experiment}, kMost).count, 0) << "events";
}

/// Where others of the same sensor have shown some, a single one counts.
TEST(StrayReadings, MayBeExpected) {
  EXPECT_EQ(strayReadings({withStray({400})}, kMost).count, 0);
  EXPECT_EQ(strayReadings({withStray({400})}, kMost, true).count, 1);
}

/// Extremes of noise with heavy tails are rarer, or not so far out.
TEST(StrayReadings, AreNotTheExtremesOfHeavyTails) {
  for (const double degrees : {3.0, 4.0, 6.0}) {
    std::mt19937_64 engine(5);
    std::student_t_distribution<double> heavy(degrees);
    std::vector<Experiment> all(20, recorded());
    for (Experiment& experiment : all)
      for (int t = 0; t < kSamples; ++t) experiment.y[t] += 0.1 * heavy(engine);
    EXPECT_EQ(strayReadings(all, kMost).count, 0) << degrees;
  }
}

}  // namespace
}  // namespace uncertainty_identification
