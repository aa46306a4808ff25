#include "uncertainty_identification/model/block.h"

#include <gtest/gtest.h>

#include <set>

#include "support/random_system.h"

namespace uncertainty_identification {
namespace {

std::vector<Experiment> experiments(double missing) {
  test::RandomSystemOptions options;
  options.experiments = 21;
  options.min_samples = 30;
  options.max_samples = 90;
  options.missing = missing;
  return test::randomSystem(options, 1).experiments;
}

TEST(Blocks, HoldEveryExperimentOnce) {
  const std::vector<Experiment> data = experiments(0.2);
  const std::vector<Block> blocks = makeBlocks(data);
  ASSERT_EQ(blocks.size(), 3u);
  std::set<int> seen;
  for (const Block& block : blocks) {
    for (int lane = 0; lane < block.lanes; ++lane) {
      const auto at = static_cast<std::size_t>(lane);
      const Experiment& experiment = data[static_cast<std::size_t>(block.index[at])];
      EXPECT_TRUE(seen.insert(block.index[at]).second);
      EXPECT_EQ(block.experiments[at], &experiment);
      ASSERT_EQ(block.lengths[at], experiment.samples());
      for (int k = 0; k < block.samples; ++k) {
        const bool within = k < experiment.samples();
        const bool measured = within && experiment.isValid(k);
        EXPECT_EQ(block.u(lane, k), within ? experiment.u[k] : 0);
        EXPECT_EQ(block.y(lane, k), measured ? experiment.y[k] : 0);
        EXPECT_EQ(block.weight(lane, k), measured ? 1 : 0);
      }
    }
    EXPECT_TRUE(block.y.bottomRows(kLanes - block.lanes).isZero(0));
  }
  EXPECT_EQ(seen.size(), data.size());
}

TEST(Blocks, GroupExperimentsOfSimilarLength) {
  const std::vector<Experiment> data = experiments(0);
  int last = 1000;
  for (const Block& block : makeBlocks(data)) {
    for (int lane = 0; lane < block.lanes; ++lane) {
      EXPECT_LE(block.lengths[static_cast<std::size_t>(lane)], last);
      last = block.lengths[static_cast<std::size_t>(lane)];
    }
    EXPECT_EQ(block.samples, block.lengths[0]);
    EXPECT_TRUE(block.ragged);
    EXPECT_FALSE(block.gaps);
  }
}

TEST(Blocks, TellGapsAndEqualLengths) {
  std::vector<Experiment> data(experiments(0));
  data.resize(3);
  for (Experiment& experiment : data) {
    experiment.u.conservativeResize(30);
    experiment.y.conservativeResize(30);
  }
  EXPECT_FALSE(makeBlocks(data)[0].ragged);
  EXPECT_FALSE(makeBlocks(data)[0].gaps);
  data[2].valid.assign(30, 1);
  EXPECT_FALSE(makeBlocks(data)[0].gaps);
  data[2].valid[29] = 0;
  EXPECT_TRUE(makeBlocks(data)[0].gaps);
  EXPECT_TRUE(makeBlocks({}).empty());
}

}  // namespace
}  // namespace uncertainty_identification
