#include "uncertainty_identification/ros/load_data.h"

#include <gtest/gtest.h>

#include <fstream>

#include "ros/bag_writer.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

Experiment makeExperiment(const std::string& id) {
  Experiment experiment;
  experiment.id = id;
  experiment.sample_time = 0.1;
  experiment.start_time = 1;
  experiment.u = Eigen::VectorXd::Random(30);
  experiment.y = Eigen::VectorXd::Random(30);
  return experiment;
}

void writeCsvFile(const std::string& path) {
  std::ofstream file(path);
  file << "t,u,y\n";
  for (int k = 0; k < 30; ++k) file << 0.1 * k << "," << k % 3 << "," << k % 4 << "\n";
}

std::vector<std::string> idsOf(const LoadedData& data) {
  std::vector<std::string> ids;
  for (const auto& experiment : data.experiments) ids.push_back(experiment.id);
  return ids;
}

using Ids = std::vector<std::string>;

TEST(LoadData, ReadsBagsCsvFilesAndFoldersInOrder) {
  const TemporaryFolder folder;
  writeBag(folder / "b.bag", {makeExperiment("from_bag")});
  writeCsvFile(folder / "a.csv");
  writeCsvFile(folder / "c.csv");
  std::ofstream(folder / "notes.txt") << "not data";
  EXPECT_EQ(idsOf(loadData({folder.path()}, {})), (Ids{"a", "from_bag", "c"}));
  EXPECT_EQ(idsOf(loadData({folder / "c.csv", folder / "b.bag"}, {})), (Ids{"c", "from_bag"}));
}

TEST(LoadData, FilesOfOneLoggerShareARemark) {
  const TemporaryFolder folder;
  for (const char* name : {"a.csv", "b.tsv", "c.csv"})
    std::ofstream(folder / name) << "time_ms;u;y\n0;1;2\n500;3;4\n1000;5;6\n";
  std::ofstream(folder / "d.dat") << "t u y\n0 1 2\n0.5 3 4\n";
  const LoadedData data = loadData({folder.path(), folder / "d.dat"}, {});
  EXPECT_EQ(idsOf(data), (Ids{"a", "b", "c", "d"}));
  EXPECT_EQ(
      data.warnings,
      (std::vector<std::string>{"the columns were read as follows: the time is 'time_ms' in ms"}));
}

TEST(LoadData, AWarningOfSeveralFilesIsSaidOnce) {
  const TemporaryFolder folder;
  for (const char* name : {"a.csv", "b.csv", "c.csv"}) {
    std::ofstream file(folder / name);
    file << "t,u,y\n";
    for (int k = 0; k < 30; ++k) file << 20 * k << "," << k % 3 << "," << k % 4 << "\n";
  }
  const std::vector<std::string> warnings = loadData({folder.path()}, {}).warnings;
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].rfind(folder / "a.csv" + " and 2 other files: t holds whole numbers", 0),
            0u)
      << warnings[0];
  EXPECT_EQ(loadData({folder / "a.csv"}, {}).warnings[0].rfind(folder / "a.csv" + ": t holds", 0),
            0u);
}

TEST(LoadData, ConfiguredColumnsAndModesHoldForFiles) {
  const TemporaryFolder folder;
  std::ofstream file(folder / "log.csv");
  file << "stamp;volt;angle\n";
  for (int k = 0; k < 40; ++k) file << 0.5 * k << ";" << k << ";180\n";
  file.close();
  Configuration configuration;
  configuration.input.column = "volt";
  configuration.output.column = "angle";
  configuration.output.scale = 0.5;
  configuration.experiment.mode = ExperimentMode::duration;
  configuration.experiment.duration = 10;
  const LoadedData data = loadData({folder / "log.csv"}, configuration);
  EXPECT_EQ(idsOf(data), (Ids{"log_000", "log_001"}));
  EXPECT_EQ(data.experiments.at(1).y(0), 90);
}

TEST(LoadData, IdsOfSeveralFilesGetTheirFilesName) {
  const TemporaryFolder folder;
  writeBag(folder / "one.bag", {makeExperiment("x")});
  writeBag(folder / "two.bag", {makeExperiment("x")});
  EXPECT_EQ(idsOf(loadData({folder / "one.bag", folder / "two.bag"}, {})), (Ids{"one/x", "two/x"}));
}

TEST(LoadData, WhatIsNoDataIsNamed) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& path) {
    return messageOf<FileError>([&] { loadData({path}, {}); });
  };
  EXPECT_NE(message(folder / "absent").find("absent' does not exist"), std::string::npos);
  EXPECT_NE(message(folder.path()).find("holds no .bag, .csv or .tsv"), std::string::npos);
  std::ofstream(folder / "notes.md") << "not data";
  EXPECT_NE(message(folder / "notes.md")
                .find("is not a .bag file, a .csv file (or .tsv, .txt, .dat, .log) or a folder"),
            std::string::npos);
}

TEST(LoadData, ReasonsAreToldWhenNothingIsLeft) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a.csv") << "t,u,y\n0,1,2\n0.1,1,2\n0.05,1,2\n";
  const auto message = messageOf<DataError>([&] { loadData({folder / "a.csv"}, {}); });
  EXPECT_NE(message.find("no experiment was found in the data\na: "), std::string::npos) << message;
}

}  // namespace
}  // namespace uncertainty_identification
