#include "session/experiment_store.h"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "data/experiment_checks.h"
#include "session/store_writer.h"
#include "support/csv_experiment_files.h"
#include "support/error_message.h"
#include "support/example1.h"
#include "support/plain_estimate.h"
#include "support/temporary_folder.h"
#include "support/wait_for.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/identifier.h"
#include "uncertainty_identification/io/result_json.h"

namespace uncertainty_identification {
namespace {

namespace fs = std::filesystem;

/// Limits that leave room for so many.
LimitOptions newest(int count) {
  LimitOptions limits;
  limits.max_experiments = count;
  return limits;
}

const LimitOptions kMany = newest(1000);

std::vector<KeptExperiment> numberedExperiments(int count) {
  std::vector<KeptExperiment> all;
  for (auto& experiment : example1Experiments(count)) {
    experiment.scalars["temp"] = 20 + static_cast<double>(all.size());
    all.push_back({all.size() + 1, std::make_shared<const Experiment>(std::move(experiment))});
  }
  return all;
}

std::vector<std::string> idsOf(const StoredState& state) {
  std::vector<std::string> ids;
  for (const auto& kept : state.kept) ids.push_back(kept.experiment->id);
  return ids;
}

void writeText(const std::string& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}

std::string fileOf(const TemporaryFolder& folder, int number) {
  return folder / ("current/experiment_0000000" + std::to_string(number) + ".bag");
}

TEST(ExperimentStore, GivesBackWhatWasWritten) {
  const TemporaryFolder folder;
  const auto experiments = numberedExperiments(3);
  {
    ExperimentStore store(folder.path(), csvExperimentFiles());
    EXPECT_TRUE(store.load(kMany).kept.empty());
    for (const auto& experiment : experiments) store.write(experiment);
  }
  const StoredState state = ExperimentStore(folder.path(), csvExperimentFiles()).load(kMany);
  ASSERT_EQ(state.kept.size(), 3U);
  EXPECT_EQ(state.last_number, 3U);
  EXPECT_EQ(state.count, 3);
  EXPECT_TRUE(state.warnings.empty());
  for (std::size_t k = 0; k < 3; ++k) {
    const Experiment &read = *state.kept[k].experiment, &written = *experiments[k].experiment;
    EXPECT_EQ(state.kept[k].number, k + 1);
    EXPECT_EQ(read.id, written.id);
    EXPECT_NEAR(read.start_time, written.start_time, 1e-9);
    EXPECT_EQ(dataFingerprint({read}), dataFingerprint({written}));
  }
}

TEST(ExperimentStore, ReadsTheNewestAndCountsAll) {
  const TemporaryFolder folder;
  ExperimentStore store(folder.path(), csvExperimentFiles());
  const auto experiments = numberedExperiments(5);
  for (const auto& experiment : experiments) store.write(experiment);
  const StoredState state = store.load(newest(2));
  EXPECT_EQ(idsOf(state), (std::vector<std::string>{experiments[3].experiment->id,
                                                    experiments[4].experiment->id}));
  EXPECT_EQ(state.count, 5);
  EXPECT_EQ(state.last_number, 5U);
}

TEST(ExperimentStore, DamagedFilesAreMovedAsideAndTheOthersLoad) {
  const TemporaryFolder folder;
  ExperimentStore store(folder.path(), csvExperimentFiles());
  for (const auto& experiment : numberedExperiments(5)) store.write(experiment);
  fs::resize_file(fileOf(folder, 2), 1000);
  writeText(fileOf(folder, 3), "not an experiment");
  writeText(fileOf(folder, 5), "");
  writeText(folder / "current/result.json", "{");
  writeText(folder / "configuration.json", "[]");
  const StoredState state = store.load(kMany);
  EXPECT_EQ(state.kept.size(), 2U);
  EXPECT_EQ(state.count, 2);
  EXPECT_EQ(state.last_number, 5U);
  EXPECT_FALSE(state.result);
  EXPECT_FALSE(state.configuration);
  EXPECT_EQ(state.warnings.size(), 5U);
  for (const std::string name : {"experiment_00000002.bag", "experiment_00000005.bag",
                                 "result.json", "configuration.json"}) {
    EXPECT_TRUE(fs::exists(folder / ("current/damaged/" + name))) << name;
    EXPECT_GT(fs::file_size(folder / ("current/damaged/" + name + ".txt")), 10U) << name;
  }
  EXPECT_TRUE(store.load(kMany).warnings.empty());
}

TEST(ExperimentStore, AResultThatDoesNotHoldTogetherIsMovedAside) {
  const TemporaryFolder folder;
  ExperimentStore store(folder.path(), csvExperimentFiles());
  StoredResult result;
  result.estimate = std::make_shared<const Estimate>(
      test::plainEstimate(Eigen::Vector2d(1, 0.5), Eigen::Vector2d(-0.5, 0.1)));
  store.write(numberedExperiments(1).front());
  store.write(result);
  EXPECT_TRUE(store.load(kMany).result);
  const std::string path = folder / "current/result.json";
  nlohmann::json tree = nlohmann::json::parse(std::ifstream(path));
  tree["error_model"]["weights"] = {0.3, 0.3, 0.4};
  tree.erase("checksum");
  writeText(path, tree.dump());
  const StoredState state = store.load(kMany);
  EXPECT_FALSE(state.result);
  EXPECT_EQ(state.kept.size(), 1U);
  ASSERT_EQ(state.warnings.size(), 1U);
  EXPECT_NE(state.warnings[0].find("error_model: weights"), std::string::npos) << state.warnings[0];
  EXPECT_TRUE(fs::exists(folder / "current/damaged/result.json"));
}

TEST(ExperimentStore, TemporaryFilesAreRemoved) {
  const TemporaryFolder folder;
  ExperimentStore store(folder.path(), csvExperimentFiles());
  store.write(numberedExperiments(1).front());
  writeText(fileOf(folder, 2) + ".tmp.123.0", "half");
  EXPECT_EQ(store.load(kMany).kept.size(), 1U);
  EXPECT_FALSE(fs::exists(fileOf(folder, 2) + ".tmp.123.0"));
}

TEST(ExperimentStore, RejectedExperimentsAreRememberedWithTheirReasons) {
  const TemporaryFolder folder;
  ExperimentStore store(folder.path(), csvExperimentFiles());
  const auto experiments = numberedExperiments(3);
  for (const auto& experiment : experiments) store.write(experiment);
  store.reject(3, {experiments[2].experiment->id, "the rig was touched"});
  for (int k = 0; k < 4; ++k) store.reject({"cut_" + std::to_string(k), "too short"}, 2);
  const StoredState state = store.load(newest(2));
  EXPECT_EQ(state.kept.size(), 2U);
  EXPECT_EQ(state.last_number, 3U) << "its number is not given away";
  ASSERT_EQ(state.rejected.size(), 3U);
  EXPECT_EQ(state.rejected[0].id, "cut_2");
  EXPECT_EQ(state.rejected[2].id, experiments[2].experiment->id);
  EXPECT_EQ(state.rejected[2].reason, "the rig was touched");
  EXPECT_TRUE(fs::exists(folder / "current/rejected/experiment_00000003.bag"));
}

TEST(ExperimentStore, ARejectionThatACrashInterruptedIsFinished) {
  const TemporaryFolder folder;
  ExperimentStore store(folder.path(), csvExperimentFiles());
  for (const auto& experiment : numberedExperiments(2)) store.write(experiment);
  store.reject(1, {"first", "why"});
  fs::rename(folder / "current/rejected/experiment_00000001.bag", fileOf(folder, 1));
  EXPECT_EQ(store.load(kMany).kept.size(), 1U);
}

TEST(ExperimentStore, ResetPutsAllAside) {
  const TemporaryFolder folder;
  ExperimentStore store(folder.path(), csvExperimentFiles());
  store.reset();
  for (int round = 1; round <= 2; ++round) {
    store.write(numberedExperiments(1).front());
    store.reset();
    EXPECT_TRUE(store.load(kMany).kept.empty());
    EXPECT_TRUE(
        fs::exists(folder / ("reset_" + std::to_string(round) + "/experiment_00000001.bag")));
  }
}

TEST(ExperimentStore, TheResultIsPublishedAgainAsItWas) {
  const TemporaryFolder folder;
  ExperimentStore store(folder.path(), csvExperimentFiles());
  StoredResult result;
  result.configuration = example1Configuration();
  result.estimate = std::make_shared<const Estimate>(
      Identifier(result.configuration).identify(example1Experiments(8)));
  result.context = {1700000000000000005, 17, true, {8, "a", "h", 1.5, 2.5}};
  store.write(result);
  Configuration other;
  store.write(StoredConfiguration{example1Configuration(), other});
  const StoredState state = store.load(kMany);
  ASSERT_TRUE(state.result);
  EXPECT_EQ(toJson(*state.result->estimate), toJson(*result.estimate));
  EXPECT_EQ(state.result->context.sequence, 17U);
  EXPECT_EQ(state.result->context.stamp, result.context.stamp);
  EXPECT_TRUE(state.result->context.preliminary);
  EXPECT_EQ(state.result->context.window.last_id, "h");
  EXPECT_EQ(state.result->context.window.end, 2.5);
  EXPECT_EQ(loadResult(folder / "current/result.json").estimate.log_likelihood,
            result.estimate->log_likelihood);
  ASSERT_TRUE(state.configuration);
  EXPECT_EQ(state.configuration->configuration.error_model.components, 2);
}

TEST(ExperimentStore, OneNodeOnlyUsesIt) {
  const TemporaryFolder folder;
  const auto complaint = [](const std::string& path) {
    return messageOf<ConfigurationError>(
        [&] { const ExperimentStore store(path, csvExperimentFiles()); });
  };
  {
    const ExperimentStore store(folder.path(), csvExperimentFiles());
    EXPECT_NE(complaint(folder.path()).find("another node uses it"), std::string::npos);
  }
  EXPECT_EQ(complaint(folder.path()), "no exception");
  writeText(folder / "file", "");
  EXPECT_NE(complaint(folder / "file").find("store_directory"), std::string::npos);
}

// The folder goes and comes back, as a disk that is unplugged does.
TEST(StoreWriter, GoesOnInMemoryAndWritesWhatIsPendingOnceItCan) {
  const TemporaryFolder folder;
  const auto experiments = numberedExperiments(4);
  const std::string store = folder / "store", away = folder / "away";
  {
    StoreWriter writer(store, csvExperimentFiles(), LimitOptions(),
                       {[](const StoreStatus&) {},
                        [](const std::vector<std::string>&) { FAIL() << "all was written"; }});
    writer.load();
    writer.keep(experiments[0]);
    ASSERT_TRUE(waitFor([&] { return writer.status().stored == 1; }));
    fs::rename(store, away);
    for (std::size_t k = 1; k < 4; ++k) writer.keep(experiments[k]);
    ASSERT_TRUE(waitFor([&] { return writer.status().failing; }));
    EXPECT_EQ(writer.status().pending, 3);
    EXPECT_EQ(writer.status().stored, 1);
    EXPECT_NE(writer.status().message.find(store), std::string::npos) << writer.status().message;
    EXPECT_FALSE(fs::exists(store)) << "nothing is written where the disk is missing";
    fs::rename(away, store);
    ASSERT_TRUE(waitFor([&] { return writer.status().stored == 4; }));
    EXPECT_FALSE(writer.status().failing);
    EXPECT_EQ(writer.status().message, "");
    EXPECT_EQ(writer.status().last_id, experiments[3].experiment->id);
  }
  EXPECT_EQ(ExperimentStore(store, csvExperimentFiles()).load(kMany).kept.size(), 4U);
}

TEST(StoreWriter, NamesAtItsEndWhatItCouldNotWrite) {
  const TemporaryFolder folder;
  const auto experiments = numberedExperiments(3);
  std::vector<std::string> lost;
  std::atomic<bool> failed{false};
  {
    StoreWriter writer(folder / "store", csvExperimentFiles(), LimitOptions(),
                       {[&](const StoreStatus& status) { failed = failed || status.failing; },
                        [&](const std::vector<std::string>& files) { lost = files; }});
    writer.load();
    writer.keep(experiments[0]);
    ASSERT_TRUE(waitFor([&] { return writer.status().stored == 1; }));
    fs::rename(folder / "store", folder / "away");
    writer.keep(experiments[1]);
    writer.keep(experiments[2]);
    ASSERT_TRUE(waitFor([&] { return failed.load(); }));
  }
  ASSERT_EQ(lost.size(), 2U);
  EXPECT_EQ(lost[0], "experiment '" + experiments[1].experiment->id + "'");
}

}  // namespace
}  // namespace uncertainty_identification
