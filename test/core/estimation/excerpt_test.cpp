#include "estimation/excerpt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace uncertainty_identification {
namespace {

std::vector<Experiment> experiments(int count, int samples) {
  Experiment one;
  one.u = Eigen::VectorXd::LinSpaced(samples, 0, samples - 1);
  one.y = -one.u;
  return std::vector<Experiment>(static_cast<std::size_t>(count), one);
}

long total(const std::vector<Experiment>& experiments) {
  long sum = 0;
  for (const Experiment& experiment : experiments) sum += experiment.samples();
  return sum;
}

TEST(Excerpt, KeepsSignalsTogether) {
  Experiment whole = experiments(1, 10)[0];
  whole.id = "whole";
  whole.valid = {1, 1, 1, 0, 1, 1, 1, 1, 1, 1};
  whole.scalars["temp"] = 20;
  whole.signals["load"] = whole.u;
  const Experiment piece = excerpt(whole, 3, 4);
  EXPECT_EQ(piece.id, "whole");
  EXPECT_EQ(piece.u, Eigen::Vector4d(3, 4, 5, 6));
  EXPECT_EQ(piece.y, Eigen::Vector4d(-3, -4, -5, -6));
  EXPECT_EQ(piece.valid, (std::vector<std::uint8_t>{0, 1, 1, 1}));
  EXPECT_EQ(piece.scalars.at("temp"), 20);
  EXPECT_TRUE(piece.signals.empty());
}

TEST(Thinned, LeavesLittleDataAlone) {
  EXPECT_EQ(total(fewerSamples(experiments(10, 100), 1000)), 1000);
}

class TooMuch : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(TooMuch, IsCutToAboutWhatSuffices) {
  const auto [count, samples] = GetParam();
  const std::vector<Experiment> fewer = fewerSamples(experiments(count, samples), 15000);
  ASSERT_FALSE(fewer.empty());
  EXPECT_GT(total(fewer), 12000);
  EXPECT_LE(total(fewer), 16000);
  for (const Experiment& experiment : fewer) {
    EXPECT_GE(experiment.samples(), std::min(samples, 500)) << "too short to show slow dynamics";
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, TooMuch,
                         testing::Values(std::pair{1, 100000}, std::pair{10, 3000},
                                         std::pair{30, 100000}, std::pair{100, 2000},
                                         std::pair{1000, 1000}, std::pair{2000, 100}));

}  // namespace
}  // namespace uncertainty_identification
