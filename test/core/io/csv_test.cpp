#include "uncertainty_identification/io/csv.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <clocale>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include "support/mentions.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using test::mentions;

class Csv : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = testing::TempDir() + "csv_test_" + std::to_string(::getpid());
    std::filesystem::create_directories(folder_);
    path_ = folder_ + "/motor.run.csv";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  LoadedData read(const std::string& content, const Configuration& options = {}) const {
    std::ofstream(path_, std::ios::binary) << content;
    return readCsv(path_, options);
  }

  /// The reason why the only experiment of the file is rejected.
  std::string rejection(const std::string& content, const Configuration& options = {}) const {
    const LoadedData data = read(content, options);
    EXPECT_TRUE(data.experiments.empty());
    EXPECT_EQ(data.rejected.size(), 1u);
    return data.rejected.empty() ? "" : data.rejected[0].reason;
  }

  std::string fileError(const std::string& content) const {
    try {
      read(content);
    } catch (const FileError& error) {
      return error.what();
    }
    return "";
  }

  std::string folder_, path_;
};

/// t,u,y rows k = first..last at 0.1 k, without those in `left_out`.
std::string rows(int first, int last, const std::vector<int>& left_out = {}) {
  std::string text;
  for (int k = first; k <= last; ++k) {
    if (std::find(left_out.begin(), left_out.end(), k) != left_out.end()) continue;
    text += std::to_string(0.1 * k) + "," + std::to_string(k) + "," + std::to_string(10 * k) + "\n";
  }
  return text;
}

TEST_F(Csv, ReadsTheFormWithoutExperiments) {
  const LoadedData data = read("t,u,y\n0,1,2\n0.5,3,4\n1,5,-6e-1\n");
  ASSERT_EQ(data.experiments.size(), 1u);
  const Experiment& experiment = data.experiments[0];
  EXPECT_EQ(experiment.id, "motor.run");
  EXPECT_EQ(experiment.sample_time, 0.5);
  EXPECT_EQ(experiment.start_time, 0);
  EXPECT_EQ(experiment.u, Eigen::Vector3d(1, 3, 5));
  EXPECT_EQ(experiment.y, Eigen::Vector3d(2, 4, -0.6));
  EXPECT_TRUE(experiment.valid.empty());
  EXPECT_TRUE(data.rejected.empty());
  EXPECT_TRUE(data.warnings.empty());
}

TEST_F(Csv, ReadsTheFormWithExperimentsInAnyOrderOfColumnsAndRows) {
  const LoadedData data = read(
      "y,load,experiment,u,temp,t\n"
      "1,7,b,10,20,0\n"
      "2,8,a,11,20,5\n"
      "3,7,b,12,21,1\n"
      "4,8,a,13,20,5.25\n");
  ASSERT_EQ(data.experiments.size(), 2u);
  EXPECT_EQ(data.experiments[0].id, "b");
  EXPECT_EQ(data.experiments[0].y, Eigen::Vector2d(1, 3));
  EXPECT_EQ(data.experiments[0].u, Eigen::Vector2d(10, 12));
  EXPECT_EQ(data.experiments[0].scalars, (std::map<std::string, double>{{"load", 7}}));
  EXPECT_EQ(data.experiments[0].signals.at("temp"), Eigen::Vector2d(20, 21));
  EXPECT_EQ(data.experiments[1].id, "a");
  EXPECT_EQ(data.experiments[1].start_time, 5);
  EXPECT_EQ(data.experiments[1].sample_time, 0.25);
  EXPECT_EQ(data.experiments[1].scalars,
            (std::map<std::string, double>{{"load", 8}, {"temp", 20}}));
}

TEST_F(Csv, AcceptsWhatSpreadsheetsAndPeopleWrite) {
  const LoadedData data = read(
      "\xEF\xBB\xBF# recorded by hand\r\n\r\n \"t\" , u,\"y\", \"load, \"\"net\"\" [kg]\"\r\n"
      "  # a remark, with commas\r\n"
      "0, 1 ,2,5\r\n\r\n1,+3,\t4e0,5\r\n2,\"5\",6,5");  // no line end at the end
  ASSERT_EQ(data.experiments.size(), 1u);
  EXPECT_EQ(data.experiments[0].u, Eigen::Vector3d(1, 3, 5));
  EXPECT_EQ(data.experiments[0].y, Eigen::Vector3d(2, 4, 6));
  EXPECT_EQ(data.experiments[0].scalars.at("load, \"net\" [kg]"), 5);
}

TEST_F(Csv, EmptyAndNanOutputsAreMissing) {
  const LoadedData data = read("t,u,y\n0,1,\n1,2,5\n2,3,nan\n3,4,NaN\n4,5,8\n5,6, \n");
  ASSERT_EQ(data.experiments.size(), 1u);
  const Experiment& experiment = data.experiments[0];
  EXPECT_EQ(experiment.valid, (std::vector<std::uint8_t>{0, 1, 0, 0, 1, 0}));
  EXPECT_EQ(experiment.samples(), 6);
  EXPECT_EQ(experiment.u(5), 6);
  EXPECT_EQ(experiment.y(4), 8);
}

TEST_F(Csv, MissingOutputsAreCounted) {
  std::string rows = "t,u,y\n";
  for (int k = 0; k < 100; ++k)
    rows += std::to_string(0.5 * k) + "," + std::to_string(k % 7) +
            (k < 3     ? ",nan\n"
             : k == 3  ? ",-inf\n"
             : k == 50 ? ",\n"
                       : ",1\n");
  const LoadedData data = read(rows);
  ASSERT_EQ(data.experiments.size(), 1u);
  EXPECT_EQ(data.experiments[0].validSamples(), 95);
  ASSERT_EQ(data.warnings.size(), 1u);
  EXPECT_TRUE(mentions(data.warnings[0],
                       "5 of 100 outputs are no numbers (4 NaN or infinite, 1 empty) and count as "
                       "missing"))
      << data.warnings[0];
}

TEST_F(Csv, EmptyCovariatesAreHeld) {
  const LoadedData data =
      read("t,u,y,temp,off,load\n0,1,1,,,3\n1,2,2,20,,\n2,3,3,,,\n3,4,4,22,,\n");
  ASSERT_EQ(data.experiments.size(), 1u);
  EXPECT_EQ(data.experiments[0].signals.at("temp"), Eigen::Vector4d(20, 20, 20, 22));
  EXPECT_EQ(data.experiments[0].scalars, (std::map<std::string, double>{{"load", 3}}));
}

TEST_F(Csv, NumbersDoNotDependOnTheLocale) {
  const char* found = nullptr;
  for (const char* name : {"de_DE.UTF-8", "de_DE", "fr_FR.UTF-8"}) {
    if (found == nullptr) found = std::setlocale(LC_NUMERIC, name);
  }
  const LoadedData data = read("t,u,y\n0,1.5,2\n1,3,4\n2,5,6\n");
  std::setlocale(LC_NUMERIC, "C");
  ASSERT_EQ(data.experiments.size(), 1u);
  EXPECT_EQ(data.experiments[0].u(0), 1.5);
}

TEST_F(Csv, UnreadableCellsNameFileLineColumnAndText) {
  const std::string header = "# remark\nt,u,y,load\n";
  EXPECT_TRUE(mentions(rejection(header + "0,1,2,3\n1,abc,2,3\n2,1,2,3\n"),
                       "experiment 'motor.run': " + path_ + ", line 4, column u: found 'abc'"));
  EXPECT_TRUE(mentions(rejection(header + "0,1,2,3\n1x,1,2,3\n"), "line 4, column t: found '1x'"));
  EXPECT_TRUE(
      mentions(rejection(header + "0,1,2;5,3\n1,1,2,3\n"), "line 3, column y: found '2;5'"));
  EXPECT_TRUE(
      mentions(rejection(header + "0,1,2,high\n1,1,2,3\n"), "line 3, column load: found 'high'"));
  EXPECT_TRUE(mentions(rejection(header + ",1,2,3\n1,1,2,3\n"), "line 3, column t: found ''"));
  EXPECT_TRUE(
      mentions(rejection(header + "0,1,2,3\n1,1,2\n"), "line 4: found 3 cells under 4 columns"));
}

TEST_F(Csv, ABadExperimentLosesNoOther) {
  const LoadedData data = read(
      "experiment,t,u,y\na,0,1,1\na,1,2,2\nbad,0,1,1\nbad,1,?,2\n,0,1,1\nb,0,1,1\nb,1,2,2\n"
      "back,0,1,1\nback,1,2,2\nback,0.5,3,3\ntwice,0,1,1\ntwice,0,2,2\none,0,1,1\nc,0,1,1\nc,1,2,"
      "2\n");
  std::vector<std::string> read_ids, rejected_ids;
  for (const Experiment& experiment : data.experiments) read_ids.push_back(experiment.id);
  for (const RejectedExperiment& rejected : data.rejected) rejected_ids.push_back(rejected.id);
  EXPECT_EQ(read_ids, (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(rejected_ids, (std::vector<std::string>{"bad", "", "back", "twice", "one"}));
  EXPECT_TRUE(mentions(data.rejected[1].reason, "line 6, column experiment: the cell is empty"));
  EXPECT_TRUE(
      mentions(data.rejected[2].reason, "line 11, column t: the stamp 0.5 s goes back from 1 s"));
  EXPECT_TRUE(mentions(data.rejected[3].reason, "line 13, column t: the stamp 0 s repeats 0 s"));
  EXPECT_TRUE(mentions(data.rejected[4].reason, "line 14: the experiment has one sample"));
}

TEST_F(Csv, NonFiniteStampsAreRejected) {
  EXPECT_TRUE(mentions(rejection("t,u,y\n0,1,2\nnan,1,2\n"), "line 3, column t: found nan"));
  EXPECT_TRUE(mentions(rejection("t,u,y\n0,1,2\ninf,1,2\n"), "line 3, column t: found inf"));
}

TEST_F(Csv, FilesThatAreNoTableAreErrors) {
  EXPECT_TRUE(mentions(fileError(""), "'" + path_ + "': the file is empty"));
  EXPECT_TRUE(mentions(fileError("# only\n\n"), "the file is empty"));
  EXPECT_TRUE(mentions(fileError("t,u\n0,1\n"), "line 1 is 't,u', without y"));
  EXPECT_TRUE(mentions(fileError("0,1,2\n1,2,3\n"), "no header line, and the columns are called"));
  EXPECT_TRUE(mentions(fileError("t,u,y,y\n"), "no two columns may have the same name"));
  EXPECT_TRUE(mentions(rejection("t,u,y\n"), "the file has a header but no rows"));
  EXPECT_TRUE(mentions(rejection("experiment,t,u,y\n\n"), "the file has a header but no rows"));
}

TEST_F(Csv, UnreadableFilesNameTheReason) {
  const auto messageOf = [](const std::string& path) -> std::string {
    try {
      readCsv(path);
    } catch (const FileError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_TRUE(mentions(messageOf(folder_ + "/none.csv"), "/none.csv': No such file or directory"));
  EXPECT_TRUE(mentions(messageOf(folder_), "it is a folder"));
}

TEST_F(Csv, GapsBecomeMissingSamples) {
  const LoadedData data = read("t,u,y,temp\n0,1,1,5\n0.1,2,2,5\n0.2,3,3,6\n0.6,7,7,7\n0.7,8,8,7\n");
  ASSERT_EQ(data.experiments.size(), 1u);
  const Experiment& experiment = data.experiments[0];
  EXPECT_EQ(experiment.sample_time, 0.1);
  EXPECT_EQ(experiment.valid, (std::vector<std::uint8_t>{1, 1, 1, 0, 0, 0, 1, 1}));
  EXPECT_EQ(experiment.u, (Eigen::VectorXd(8) << 1, 2, 3, 3, 3, 3, 7, 8).finished());
  EXPECT_EQ(experiment.signals.at("temp"),
            (Eigen::VectorXd(8) << 5, 5, 6, 6, 6, 6, 7, 7).finished());
  ASSERT_EQ(data.warnings.size(), 1u);
  EXPECT_TRUE(mentions(data.warnings[0], "'motor.run': 3 rows are missing"));
}

TEST_F(Csv, GapsBeyondTheLimitsAreResampled) {
  const std::string content = "t,u,y\n" + rows(0, 9) + rows(25, 34);
  Configuration options;
  options.limits.max_missing = 0.2;
  const LoadedData held =
      read(content, options);  // an output is held for three sample times at most
  ASSERT_EQ(held.experiments.size(), 1u);
  EXPECT_EQ(held.experiments[0].samples(), 35);
  EXPECT_EQ(held.experiments[0].validSamples(), 23);
  options.resampling.max_age = 0.3;
  EXPECT_TRUE(mentions(rejection(content, options), "the input is 0.4 s old at 1.3 s"));
}

TEST_F(Csv, NoticeableJitterIsKept) {
  const LoadedData data =
      read("t,u,y\n0,1,1\n0.1,2,2\n0.202,3,3\n0.3,4,4\n0.4,5,5\n0.498,6,6\n0.6,7,7\n");
  ASSERT_EQ(data.experiments.size(), 1u);
  const Experiment& experiment = data.experiments[0];
  EXPECT_EQ(experiment.sample_time, 0.1);
  EXPECT_EQ(experiment.u, (Eigen::VectorXd(7) << 1, 2, 3, 4, 5, 6, 7).finished());
  ASSERT_EQ(experiment.stamp_offset.size(), 7);
  EXPECT_NEAR(experiment.stamp_offset(2), 0.002, 1e-12);
  EXPECT_NEAR(experiment.stamp_offset(5), -0.002, 1e-12);
  EXPECT_NEAR(experiment.stamp_offset(3), 0, 1e-12);
  Configuration options;
  options.resampling.max_jitter = 1e-3;
  EXPECT_TRUE(mentions(rejection("t,u,y\n0,1,1\n0.1,2,2\n0.202,3,3\n0.3,4,4\n0.4,5,5\n", options),
                       "more than max_jitter"));
}

TEST_F(Csv, StampsRoundedInPrintAreNoJitter) {
  std::string content = "t,u,y\n";
  for (int k = 0; k < 20000; ++k) {
    char line[64];
    std::snprintf(line, sizeof line, "%.8g,%d,%d\n", 0.0016384 * k, k, k);
    content += line;
  }
  const LoadedData data = read(content);
  ASSERT_EQ(data.experiments.size(), 1u);
  EXPECT_EQ(data.experiments[0].sample_time, 0.0016384);
  EXPECT_EQ(data.experiments[0].samples(), 20000);
  EXPECT_TRUE(data.experiments[0].valid.empty());
  EXPECT_EQ(data.experiments[0].stamp_offset.size(), 0);
}

TEST_F(Csv, AGivenSampleTimeResamplesOtherRates) {
  Configuration options;
  options.sample_time = 0.2;
  const LoadedData data = read("t,u,y\n" + rows(0, 20), options);
  ASSERT_EQ(data.experiments.size(), 1u);
  EXPECT_EQ(data.experiments[0].sample_time, 0.2);
  EXPECT_EQ(data.experiments[0].samples(), 11);
  EXPECT_EQ(data.experiments[0].y(10), 200);
  options.sample_time = 0.1;
  EXPECT_EQ(read("t,u,y\n" + rows(0, 20), options).experiments[0].samples(), 21);
}

std::vector<Experiment> randomExperiments() {
  std::mt19937_64 engine(11);
  std::normal_distribution<double> normal;
  std::vector<Experiment> experiments;
  for (const auto& [id, sample_time, start] : {std::make_tuple("plain", 0.01, 0.0),
                                               {"with, comma and \"quotes\"", 1.0 / 3, 0.0},
                                               {"#1", 0.1, 1.7e9}}) {
    Experiment experiment;
    experiment.id = id;
    experiment.sample_time = sample_time;
    experiment.start_time = start;
    experiment.u = Eigen::VectorXd::NullaryExpr(300, [&] { return normal(engine); });
    experiment.y = Eigen::VectorXd::NullaryExpr(300, [&] { return std::exp(8 * normal(engine)); });
    experiments.push_back(experiment);
  }
  experiments[0].valid.assign(300, 1);
  for (const int k : {0, 7, 8, 299}) {
    experiments[0].valid[static_cast<std::size_t>(k)] = 0;
    experiments[0].y(k) = 0;
  }
  experiments[0].scalars["load [kg]"] = 0.1;
  experiments[1].scalars["load [kg]"] = -1e-310;
  experiments[1].signals["temp"] =
      Eigen::VectorXd::NullaryExpr(300, [&] { return normal(engine); });
  return experiments;
}

TEST_F(Csv, RoundTripIsExactToTheLastBit) {
  const std::vector<Experiment> written = randomExperiments();
  writeCsv(path_, written);
  const LoadedData data = readCsv(path_);
  ASSERT_EQ(data.experiments.size(), written.size());
  EXPECT_TRUE(data.rejected.empty());
  ASSERT_EQ(data.warnings.size(), 1u);
  EXPECT_TRUE(mentions(data.warnings[0], "4 of 300 outputs are no numbers (4 empty)"));
  for (std::size_t i = 0; i < written.size(); ++i) {
    const Experiment& found = data.experiments[i];
    EXPECT_EQ(found.id, written[i].id);
    EXPECT_EQ(found.sample_time, written[i].sample_time);
    EXPECT_EQ(found.start_time, written[i].start_time);
    EXPECT_EQ(found.u, written[i].u);
    EXPECT_EQ(found.y, written[i].y);
    EXPECT_EQ(found.valid, written[i].valid);
    EXPECT_EQ(found.scalars, written[i].scalars);
    EXPECT_EQ(found.signals, written[i].signals);
    EXPECT_EQ(found.stamp_offset.size(), 0);
  }
}

TEST_F(Csv, WritingKeepsStampOffsets) {
  Experiment experiment = randomExperiments()[0];
  experiment.stamp_offset =
      Eigen::VectorXd::NullaryExpr(300, [](Eigen::Index k) { return k % 3 == 0 ? 1e-3 : 0.0; });
  writeCsv(path_, {experiment});
  const LoadedData data = readCsv(path_);
  ASSERT_EQ(data.experiments.size(), 1u);
  ASSERT_EQ(data.experiments[0].stamp_offset.size(), 300);
  EXPECT_LT((data.experiments[0].stamp_offset - experiment.stamp_offset).cwiseAbs().maxCoeff(),
            1e-12);
}

TEST_F(Csv, LineBreaksInNamesAreRefused) {
  Experiment experiment = randomExperiments()[0];
  experiment.id = "two\nlines";
  EXPECT_THROW(writeCsv(path_, {experiment}), DataError);
  EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_F(Csv, FoldersThatDoNotExistAreErrors) {
  EXPECT_THROW(writeCsv(folder_ + "/none/file.csv", {}), FileError);
}

}  // namespace
}  // namespace uncertainty_identification
