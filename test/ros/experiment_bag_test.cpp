// A store of bags, as the node keeps it. What a store does with its files is tested without ROS in
// test/core/session/experiment_store_test.cpp.
#include "ros/experiment_bag.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "data/check.h"
#include "session/experiment_store.h"
#include "support/example1.h"
#include "support/temporary_folder.h"
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
