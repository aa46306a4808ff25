#include "session/saved_experiments.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "session/file_name.h"
#include "session/refused_error.h"
#include "support/csv_experiment_files.h"
#include "support/error_message.h"
#include "support/example1.h"
#include "support/temporary_folder.h"
#include "support/wait_for.h"

namespace uncertainty_identification {
namespace {

IdentificationWorker::Listener silent() {
  return {[](const WorkerResult&) {}, [](const KeptExperiment&) {},
          [](const RejectedExperiment&) {}, [] {}, [](const std::string&) {}};
}

class SavedExperimentsTest : public testing::Test {
 protected:
  void add(int count) {
    for (const auto& experiment : example1Experiments(count)) worker_.add(experiment);
    ASSERT_TRUE(waitFor([&] { return worker_.status().stored == count; }));
  }

  SavedExperiments saved(const LimitOptions& limits = {}) {
    return {folder_.path(), csvExperimentFiles(), limits, worker_};
  }

  std::string refusal(const std::string& name, const LimitOptions& limits = {}) {
    return messageOf<RefusedError>([&] { saved(limits).save(name, csvExperimentFiles().write); });
  }

  TemporaryFolder folder_;
  IdentificationWorker worker_{example1Configuration(), silent()};
};

TEST_F(SavedExperimentsTest, WhatWasSavedCanBeLoadedAgain) {
  add(3);
  const auto written = saved().save("a.bag", csvExperimentFiles().write);
  EXPECT_EQ(written.experiments, 3);
  EXPECT_EQ(written.path, folder_ / "saved/a.bag");
  EXPECT_EQ(saved().load("a.bag").known, 3);
  worker_.reject(example1Experiments(1).front().id, "the rig was touched");
  const auto loaded = saved().load("a.bag");
  EXPECT_EQ(loaded.added, 1) << "an experiment removed by a request is added again";
  EXPECT_EQ(loaded.known, 2);
  EXPECT_TRUE(waitFor([&] { return worker_.status().stored == 3; }));
}

TEST_F(SavedExperimentsTest, WithoutExperimentsNoFileIsWritten) {
  EXPECT_EQ(saved().save("a.bag", csvExperimentFiles().write).experiments, 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "saved/a.bag"));
}

TEST_F(SavedExperimentsTest, RefusesNamesThatAreNotAllowedOrInUse) {
  add(1);
  for (const std::string name : {"../a.bag", "/tmp/a.bag", "a.txt", ".bag", ""})
    EXPECT_NE(refusal(name).find("allowed: letters"), std::string::npos) << name;
  EXPECT_EQ(refusal("a.bag"), "no exception");
  EXPECT_NE(refusal("a.bag").find("already"), std::string::npos);
  LimitOptions one_file;
  one_file.max_saved_files = 1;
  EXPECT_NE(refusal("b.bag", one_file).find("limits.max_saved_files"), std::string::npos);
  SavedExperiments without_store("", csvExperimentFiles(), {}, worker_);
  EXPECT_THROW(without_store.save("a.bag", csvExperimentFiles().write), RefusedError);
  EXPECT_THROW(without_store.load("a.bag"), RefusedError);
}

TEST_F(SavedExperimentsTest, RefusesFilesThatAreTooLargeAndReportsEmptyOnes) {
  std::filesystem::create_directory(folder_ / "saved");
  std::ofstream(folder_ / "saved/empty.bag") << "experiment,t,u,y\n";
  EXPECT_THROW(saved().load("empty.bag"), Error);
  ExperimentFiles files = csvExperimentFiles();
  files.unpacked_size = [](const std::string&) { return std::uint64_t{1} << 40U; };
  SavedExperiments large(folder_.path(), files, {}, worker_);
  EXPECT_NE(messageOf<RefusedError>([&] { large.load("empty.bag"); }).find("max_bag_size"),
            std::string::npos);
}

TEST(FileName, IsPlainWithoutFoldersAndWithTheEnding) {
  for (const std::string name : {"a.html", "run_2-b.1.html"})
    EXPECT_TRUE(isPlainFileName(name, ".html")) << name;
  for (const std::string name :
       {".html", ".a.html", "a/b.html", "a.htm", "a b.html", "\xc3\xa4.html"})
    EXPECT_FALSE(isPlainFileName(name, ".html")) << name;
  EXPECT_TRUE(isPlainFileName(std::string(195, 'a') + ".html", ".html"));
  EXPECT_FALSE(isPlainFileName(std::string(196, 'a') + ".html", ".html"));
}

}  // namespace
}  // namespace uncertainty_identification
