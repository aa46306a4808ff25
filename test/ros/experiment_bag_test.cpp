// A store of bags, as the node keeps it. What a store does with its files is tested without ROS in
// test/core/session/experiment_store_test.cpp.
#include "ros/experiment_bag.h"

#include <gtest/gtest.h>
#include <rosbag/bag.h>

#include <filesystem>
#include <fstream>

#include "data/experiment_checks.h"
#include "io/read_file.h"
#include "ros/message_conversions.h"
#include "session/experiment_store.h"
#include "support/example1.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/ros/load_data.h"

namespace uncertainty_identification {
namespace {

std::vector<KeptExperiment> numberedExperiments(int count) {
  std::vector<KeptExperiment> all;
  for (auto& experiment : example1Experiments(count)) {
    experiment.scalars["temp"] = 20 + static_cast<double>(all.size());
    all.push_back({all.size() + 1, std::make_shared<const Experiment>(std::move(experiment))});
  }
  return all;
}

TEST(ExperimentBag, AStoreOfBagsGivesBackWhatWasWritten) {
  const TemporaryFolder folder;
  const auto experiments = numberedExperiments(4);
  ExperimentStore store(folder.path(), experimentBags());
  for (const auto& experiment : experiments) store.write(experiment);
  std::filesystem::resize_file(folder / "current/experiment_00000004.bag", 1000);
  const StoredState state = store.load(LimitOptions());
  ASSERT_EQ(state.kept.size(), 3U);
  EXPECT_EQ(state.warnings.size(), 1U) << "of the truncated bag";
  for (std::size_t k = 0; k < 3; ++k) {
    const Experiment &read = *state.kept[k].experiment, &written = *experiments[k].experiment;
    EXPECT_EQ(read.id, written.id);
    EXPECT_NEAR(read.start_time, written.start_time, 1e-9);
    EXPECT_EQ(dataFingerprint({read}), dataFingerprint({written}));
  }
}

/// One changed bit in each byte: an error, or the experiment as it was written.
TEST(ExperimentBag, NoChangedBitGoesUnnoticed) {
  const TemporaryFolder folder;
  Experiment written = example1Experiments(1).front();
  written.u = written.u.head(30).eval();
  written.y = written.y.head(30).eval();
  writeExperimentBag(folder / "a.bag", {&written});
  const std::string bytes = readFile(folder / "a.bag");
  int damaged = 0;
  for (std::size_t k = 0; k < bytes.size(); ++k) {
    std::string changed = bytes;
    changed[k] = static_cast<char>(changed[k] ^ (1 << k % 8));
    std::ofstream(folder / "b.bag", std::ios::binary) << changed;
    try {
      const LoadedData data = readExperimentBag(folder / "b.bag");
      if (data.experiments.empty()) {
        ++damaged;
        continue;
      }
      ASSERT_EQ(dataFingerprint(data.experiments), dataFingerprint({written})) << "byte " << k;
      ASSERT_EQ(data.experiments.front().id, written.id) << "byte " << k;
    } catch (const Error&) {
      ++damaged;
    }
  }
  EXPECT_GT(damaged, 30 * 16) << "at least the bytes of the samples";
}

TEST(ExperimentBag, AChangedSampleCostsTheExperimentAndIsTold) {
  const TemporaryFolder folder;
  ExperimentStore store(folder.path(), experimentBags());
  const auto experiments = numberedExperiments(2);
  for (const auto& experiment : experiments) store.write(experiment);
  const std::string path = folder / "current/experiment_00000001.bag";
  std::string bytes = readFile(path);
  const double sample = experiments[0].experiment->y[50];
  const std::string stored(reinterpret_cast<const char*>(&sample), sizeof sample);
  const std::size_t at = bytes.find(stored);
  ASSERT_NE(at, std::string::npos);
  bytes[at + 6] = static_cast<char>(bytes[at + 6] ^ 1);
  std::ofstream(path, std::ios::binary) << bytes;
  const StoredState state = store.load(LimitOptions());
  EXPECT_EQ(state.kept.size(), 1U);
  ASSERT_EQ(state.warnings.size(), 1U);
  EXPECT_NE(state.warnings[0].find("checksum"), std::string::npos) << state.warnings[0];
}

/// As versions wrote them that knew no checksum.
TEST(ExperimentBag, BagsWithoutAChecksumAreRead) {
  const TemporaryFolder folder;
  const Experiment written = example1Experiments(1).front();
  rosbag::Bag bag(folder / "old.bag", rosbag::bagmode::Write);
  bag.write("/experiment", ros::Time(5), toMessage(written));
  bag.close();
  const LoadedData data = readExperimentBag(folder / "old.bag");
  ASSERT_EQ(data.experiments.size(), 1U);
  EXPECT_EQ(dataFingerprint(data.experiments), dataFingerprint({written}));
}

TEST(ExperimentBag, TheFolderOfAStoreIsDataForTheTools) {
  const TemporaryFolder folder;
  ExperimentStore store(folder.path(), experimentBags());
  for (const auto& experiment : numberedExperiments(3)) store.write(experiment);
  const LoadedData data = loadData({folder / "current"}, example1Configuration());
  ASSERT_EQ(data.experiments.size(), 3U);
  EXPECT_EQ(data.experiments[2].id, numberedExperiments(3)[2].experiment->id);
}

}  // namespace
}  // namespace uncertainty_identification
