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
  EXPECT_NE(message(folder.path()).find("holds no .bag or .csv"), std::string::npos);
  std::ofstream(folder / "notes.txt") << "not data";
  EXPECT_NE(message(folder / "notes.txt").find("is not a .bag file, a .csv file or a folder"),
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
