#include "explanation/after_input_changes.h"

#include <gtest/gtest.h>

#include <random>

namespace uncertainty_identification {
namespace {

constexpr int kSamples = 200, kHeld = 40, kDelay = 2;

/// Experiments whose input changes its sign every kHeld samples, or at each.
FitData held(int held) {
  std::vector<Experiment> experiments(4);
  for (std::size_t r = 0; r < experiments.size(); ++r) {
    Experiment& experiment = experiments[r];
    experiment.id = std::to_string(r);
    experiment.sample_time = 1;
    experiment.u = experiment.y = Eigen::VectorXd::Zero(kSamples);
    for (int t = 0; t < kSamples; ++t) experiment.u[t] = (t / held) % 2 == 0 ? 1 : -1;
  }
  return FitData(experiments);
}

/// Marks the sample at `after` behind each multiple of kHeld.
std::vector<Signals> marked(const FitData& data, int after) {
  std::vector<Signals> all;
  for (const Block& block : data.blocks()) {
    Signals marks = Signals::Zero(block.u.rows(), block.u.cols());
    for (int t = kHeld; t < kSamples; t += kHeld) marks.col(t + after).setOnes();
    all.push_back(marks);
  }
  return all;
}

TEST(AfterInputChanges, IsImprobableWhereLargeResidualsFollowTheInput) {
  const FitData data = held(kHeld);
  EXPECT_LT(afterInputChanges(marked(data, kDelay + 3), data, kDelay), 1e-9);
  EXPECT_EQ(afterInputChanges(marked(data, kHeld / 2), data, kDelay), 1);
  EXPECT_EQ(afterInputChanges(marked(data, 0), data, kDelay), 1) << "it does not act yet";
}

/// Residuals of the same size, or larger within three samples behind each change of a covariate.
TEST(SizeByChanges, IsImprobableWhereResidualsGrowBehindACovariate) {
  const FitData still = held(kSamples);
  std::vector<Experiment> experiments = still.experiments();
  for (Experiment& experiment : experiments) {
    Eigen::VectorXd load = Eigen::VectorXd::Zero(kSamples);
    for (int t = 0; t < kSamples; ++t) load[t] = (t / kHeld) % 2;
    experiment.signals["load"] = load;
  }
  const FitData moved(experiments);
  std::vector<Signals> residuals;
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (const Block& block : moved.blocks())
    residuals.push_back(
        Signals::NullaryExpr(block.u.rows(), block.u.cols(), [&] { return normal(random); }));
  EXPECT_EQ(sizeByChanges(residuals, moved, kDelay), 1);
  for (Signals& signal : residuals)
    for (int t = kHeld; t < kSamples; t += kHeld) signal.middleCols(t, 4) *= 6;
  EXPECT_LT(sizeByChanges(residuals, moved, kDelay), 1e-6);
  EXPECT_EQ(sizeByChanges(residuals, still, kDelay), 1) << "nothing is known to change";
}

TEST(AfterInputChanges, CannotBeToldOfAnInputThatAlwaysChanges) {
  const FitData data = held(1);
  EXPECT_GT(afterInputChanges(marked(data, kDelay + 3), data, kDelay), 0.05);
}

}  // namespace
}  // namespace uncertainty_identification
