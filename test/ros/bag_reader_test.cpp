#include "uncertainty_identification/ros/bag_reader.h"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Float32.h>
#include <std_msgs/Float64.h>
#include <std_msgs/Float64MultiArray.h>
#include <std_msgs/String.h>

#include <fstream>
#include <random>

#include "ros/bag_writer.h"
#include "ros/message_conversions.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

constexpr double kPeriod = 0.01;  // [s]

// Two experiments with what a bag can carry: missing samples, constant and measured covariates.
std::vector<Experiment> experiments() {
  std::mt19937_64 engine(1);
  std::normal_distribution<double> normal;
  std::vector<Experiment> list(2);
  for (std::size_t r = 0; r < list.size(); ++r) {
    auto& experiment = list[r];
    experiment.id = "run_" + std::to_string(r);
    experiment.sample_time = kPeriod;
    experiment.start_time = 1 + static_cast<double>(r) * 2;
    const int samples = 50 + 10 * static_cast<int>(r);
    experiment.u = Eigen::VectorXd::NullaryExpr(samples, [&] { return normal(engine); });
    experiment.y = Eigen::VectorXd::NullaryExpr(samples, [&] { return normal(engine); });
    experiment.scalars["load"] = 2.5 + static_cast<double>(r);
    experiment.signals["temp"] = Eigen::VectorXd::LinSpaced(samples, 20, 21);
  }
  list[1].valid.assign(60, 1);
  list[1].valid[7] = 0;
  return list;
}

Configuration withCovariates() {
  Configuration configuration;
  configuration.sample_time = kPeriod;
  configuration.covariates = {{"temp", "covariate/temp", "auto"},
                              {"load", "covariate/load", "auto"}};
  return configuration;
}

void expectEqual(const Experiment& actual, const Experiment& expected) {
  EXPECT_EQ(actual.id, expected.id);
  EXPECT_NEAR(actual.start_time, expected.start_time, 1e-12);
  EXPECT_EQ(actual.sample_time, expected.sample_time);
  ASSERT_EQ(actual.samples(), expected.samples());
  EXPECT_EQ(actual.u, expected.u);
  for (int k = 0; k < expected.samples(); ++k) {
    EXPECT_EQ(actual.isValid(k), expected.isValid(k)) << k;
    if (expected.isValid(k)) EXPECT_EQ(actual.y[k], expected.y[k]) << k;
  }
  EXPECT_EQ(actual.scalars, expected.scalars);
  ASSERT_EQ(actual.signals.size(), expected.signals.size());
  for (const auto& [name, signal] : expected.signals) EXPECT_EQ(actual.signals.at(name), signal);
}

class BagReaderTest : public testing::Test {
 protected:
  // A bag of header-less topics as rigs record them: 100 Hz command, 50 Hz measurement, and a
  // marker.
  void writeHeaderless(rosbag::CompressionType compression = rosbag::compression::Uncompressed) {
    rosbag::Bag bag(path_, rosbag::bagmode::Write);
    bag.setCompression(compression);
    std_msgs::Bool marker;
    std_msgs::Float64 command;
    std_msgs::Float32 measurement;
    for (int k = 0; k < 200; ++k) {
      const ros::Time stamp(10 + k / 100, static_cast<std::uint32_t>(k % 100) * 10000000);
      marker.data = k < 100;
      if (k % 100 == 0) bag.write("experiment/active", stamp, marker);
      command.data = k % 7;
      bag.write("/actuator/command", stamp, command);
      measurement.data = static_cast<float>(k % 5);
      if (k % 2 == 0) bag.write("/sensor/measurement", stamp, measurement);
    }
    bag.close();
  }

  std::string contentOf(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  void writeFile(const std::string& content) { std::ofstream(path_, std::ios::binary) << content; }

  TemporaryFolder folder_;
  std::string path_ = folder_ / "data.bag";
};

TEST_F(BagReaderTest, SignalsAreScaledAndCovariatesOfFilesArePassedOver) {
  writeHeaderless();
  Configuration configuration;
  const auto plain = readBag(path_, configuration);
  configuration.input.scale = -2;
  configuration.output.offset = 7;
  configuration.covariates = {{"temp", "", "auto", "temperature"}};
  const auto scaled = readBag(path_, configuration);
  ASSERT_EQ(scaled.experiments.size(), 1u);
  EXPECT_EQ(scaled.experiments[0].u, -2 * plain.experiments.at(0).u);
  const Eigen::VectorXd moved = scaled.experiments[0].y - plain.experiments.at(0).y;
  EXPECT_LT((moved.array() - 7).abs().maxCoeff(), 1e-12);
}

TEST_F(BagReaderTest, GivesBackWhatWasWritten) {
  const auto written = experiments();
  writeBag(path_, written);
  const auto data = readBag(path_, withCovariates());
  EXPECT_TRUE(data.rejected.empty());
  ASSERT_EQ(data.experiments.size(), written.size());
  for (std::size_t r = 0; r < written.size(); ++r) expectEqual(data.experiments[r], written[r]);
}

TEST_F(BagReaderTest, ReadsHeaderlessTopicsOfAnyCompression) {
  for (const auto compression :
       {rosbag::compression::Uncompressed, rosbag::compression::BZ2, rosbag::compression::LZ4}) {
    writeHeaderless(compression);
    const auto data = readBag(path_, Configuration());
    ASSERT_EQ(data.experiments.size(), 1U);
    const auto& experiment = data.experiments.front();
    EXPECT_EQ(experiment.start_time, 10);
    EXPECT_DOUBLE_EQ(experiment.sample_time, 0.02);
    ASSERT_EQ(experiment.samples(), 50);
    for (int k = 0; k < 50; ++k) {
      EXPECT_EQ(experiment.u[k], 2 * k % 7);
      EXPECT_EQ(experiment.y[k], 2 * k % 5);
    }
  }
}

TEST_F(BagReaderTest, CutsByDuration) {
  writeHeaderless();
  Configuration configuration;
  configuration.experiment.mode = ExperimentMode::duration;
  configuration.experiment.duration = 0.5;
  const auto data = readBag(path_, configuration);
  ASSERT_EQ(data.experiments.size(), 4U);
  for (const auto& experiment : data.experiments) EXPECT_EQ(experiment.samples(), 25);
}

TEST_F(BagReaderTest, ReadsTwoSignalsFromOneTopic) {
  {
    rosbag::Bag bag(path_, rosbag::bagmode::Write);
    std_msgs::Float64MultiArray state;
    for (int k = 1; k <= 100; ++k) {
      state.data = {k * 1., k * 2.};
      bag.write("/lab/state", ros::Time(k, 0), state);
    }
    state.data = {1};
    bag.write("/lab/state", ros::Time(101, 0), state);
  }
  Configuration configuration;
  configuration.input = {"", "lab/state", "data[0]"};
  configuration.output = {"", "lab/state", "state.data[1]"};
  configuration.experiment.mode = ExperimentMode::gap;
  configuration.experiment.gap = 5;
  const auto data = readBag(path_, configuration);
  ASSERT_EQ(data.experiments.size(), 1U);
  EXPECT_EQ(data.experiments[0].y[10], 2 * data.experiments[0].u[10]);
  ASSERT_FALSE(data.warnings.empty());
  EXPECT_NE(data.warnings[0].find("output: 1 messages of topic '/lab/state' were left out"),
            std::string::npos)
      << data.warnings[0];
}

TEST_F(BagReaderTest, OrderInTheFileDoesNotMatter) {
  {
    rosbag::Bag bag(path_, rosbag::bagmode::Write);
    bag.setChunkThreshold(1000);
    std_msgs::Float64 value;
    for (const int first : {1, 2})
      for (int k = first; k <= 100; k += 2) {
        value.data = k;
        bag.write("/actuator/command", ros::Time(k, 0), value);
        bag.write("/sensor/measurement", ros::Time(k, 0), value);
      }
  }
  Configuration configuration;
  configuration.experiment.mode = ExperimentMode::gap;
  configuration.experiment.gap = 5;
  const auto data = readBag(path_, configuration);
  ASSERT_EQ(data.experiments.size(), 1U);
  ASSERT_EQ(data.experiments[0].samples(), 100);
  EXPECT_EQ(data.experiments[0].y, Eigen::VectorXd::LinSpaced(100, 1, 100));
}

TEST_F(BagReaderTest, ReadsCompleteExperiments) {
  const auto written = experiments();
  {
    rosbag::Bag bag(path_, rosbag::bagmode::Write);
    for (const auto& experiment : written)
      bag.write("/identification/stored", ros::Time(5, 0), toMessage(experiment));
    auto broken = toMessage(written[0]);
    broken.y.pop_back();
    bag.write("/identification/stored", ros::Time(6, 0), broken);
  }
  const auto data = readBag(path_, Configuration());
  ASSERT_EQ(data.experiments.size(), written.size());
  for (std::size_t r = 0; r < written.size(); ++r) expectEqual(data.experiments[r], written[r]);
  ASSERT_EQ(data.rejected.size(), 1U);
  EXPECT_NE(data.rejected[0].reason.find("y has 49 values, but u has 50"), std::string::npos);

  Configuration by_topic;
  by_topic.experiment.mode = ExperimentMode::message;
  by_topic.experiment.topic = "identification/stored";
  EXPECT_EQ(readBag(path_, by_topic).experiments.size(), written.size());
  by_topic.experiment.topic = "what/the/node/listens/to";
  EXPECT_EQ(readBag(path_, by_topic).experiments.size(), written.size()) << "a node's own store";
}

TEST_F(BagReaderTest, MissingTopicListsThoseThere) {
  writeHeaderless();
  Configuration configuration;
  configuration.output.topic = "odom";
  const auto message = messageOf<ConfigurationError>([&] { readBag(path_, configuration); });
  EXPECT_NE(message.find("no topic '/odom' (output)"), std::string::npos) << message;
  EXPECT_NE(message.find("/sensor/measurement [std_msgs/Float32]"), std::string::npos) << message;
}

TEST_F(BagReaderTest, WrongFieldListsThoseThere) {
  writeHeaderless();
  Configuration configuration;
  configuration.output.field = "dat";
  const auto message = messageOf<ConfigurationError>([&] { readBag(path_, configuration); });
  EXPECT_NE(message.find("no numeric field 'dat'; its numeric fields are 'data'"),
            std::string::npos)
      << message;
}

TEST_F(BagReaderTest, MarkerOfAnotherTypeIsRefused) {
  writeHeaderless();
  Configuration configuration;
  configuration.experiment.topic = "/actuator/command";
  const auto message = messageOf<ConfigurationError>([&] { readBag(path_, configuration); });
  EXPECT_NE(message.find("must be std_msgs/Bool or"), std::string::npos) << message;
}

TEST_F(BagReaderTest, UnreadableFilesAreNamed) {
  const auto message = [&] {
    return messageOf<FileError>([&] { readBag(path_, Configuration()); });
  };
  EXPECT_NE(message().find("No such file"), std::string::npos) << message();
  writeFile("");
  EXPECT_NE(message().find("empty"), std::string::npos) << message();
  writeFile("t,u,y\n0,1,2\n");
  EXPECT_NE(message().find("is not a ROS bag"), std::string::npos) << message();
  EXPECT_NE(messageOf<FileError>([&] { readBag(folder_.path(), {}); }).find("directory"),
            std::string::npos);
}

TEST_F(BagReaderTest, BagThatWasNotClosedAsksForReindex) {
  writeHeaderless();
  std::string content = contentOf(path_);
  const auto index = content.find("index_pos=");
  for (std::size_t i = 0; i < 8; ++i) content[index + 10 + i] = 0;
  writeFile(content);
  const auto message = messageOf<FileError>([&] { readBag(path_, {}); });
  EXPECT_NE(message.find("rosbag reindex"), std::string::npos) << message;
}

TEST_F(BagReaderTest, TruncatedAndChangedBagsAreErrorsNeverCrashes) {
  writeBag(path_, experiments());
  const std::string content = contentOf(path_);
  std::mt19937_64 engine(2);
  int refused = 0;
  for (int run = 0; run < 300; ++run) {
    std::string changed = content;
    if (run % 3 == 0) changed.resize(engine() % changed.size());
    for (int i = 0; i < 8 && !changed.empty(); ++i)
      changed[engine() % changed.size()] = static_cast<char>(engine());
    writeFile(changed);
    try {
      readBag(path_, withCovariates());
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 90);
}

TEST_F(BagReaderTest, ServiceModeCannotCutABag) {
  writeHeaderless();
  Configuration configuration;
  configuration.experiment.mode = ExperimentMode::service;
  EXPECT_THROW(readBag(path_, configuration), ConfigurationError);
}

TEST_F(BagReaderTest, OverlappingExperimentsAreNotWritten) {
  auto list = experiments();
  list[1].start_time = 1.2;
  EXPECT_THROW(writeBag(path_, list), DataError);
  EXPECT_FALSE(std::filesystem::exists(path_));
  EXPECT_THROW(writeBag(folder_ / "absent/data.bag", experiments()), FileError);
}

}  // namespace
}  // namespace uncertainty_identification
