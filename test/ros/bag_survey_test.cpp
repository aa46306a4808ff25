#include "ros/bag_survey.h"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosgraph_msgs/Log.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/LaserScan.h>
#include <std_msgs/Float64.h>

#include <cmath>
#include <fstream>
#include <random>

#include "io/inspection_yaml.h"
#include "ros/bag_writer.h"
#include "ros/survey_data.h"
#include "support/error_message.h"
#include "support/mentions.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/ros/load_data.h"

namespace uncertainty_identification {
namespace {

class BagSurvey : public testing::Test {
 protected:
  /// A command without header and a robot's answers: joints by index, a twist, a scan, a log.
  std::string robotBag(int samples = 600) const {
    const std::string path = folder_ / "robot.bag";
    rosbag::Bag bag(path, rosbag::bagmode::Write);
    std::mt19937 random(4);
    double level = 1, speed = 0;
    for (int k = 0; k < samples; ++k) {
      const ros::Time now(10 + 0.02 * k);
      if (k % 8 == 0) level = random() % 2 == 0 ? 1 : -1;
      std_msgs::Float64 command;
      command.data = level;
      bag.write("/motor/command", now, command);
      sensor_msgs::JointState joints;
      joints.header.stamp = now - ros::Duration(0.001);
      joints.name = {"left", "right"};
      joints.position = {0.5 * k, 3};
      joints.velocity = {speed, k % 2 == 0 ? std::nan("") : -speed};
      bag.write("/joint_states", now, joints);
      sensor_msgs::LaserScan scan;
      scan.ranges.assign(360, static_cast<float>(k));
      bag.write("/scan", now, scan);
      rosgraph_msgs::Log log;
      log.line = static_cast<unsigned>(k);
      bag.write("/rosout", now, log);
      speed = 0.8 * speed + 0.5 * level + 1e-3 * (random() % 100);
    }
    return path;
  }

  static const Channel* find(const Survey& survey, const std::string& name) {
    for (const Channel& channel : survey.channels)
      if (channel.name == name) return &channel;
    return nullptr;
  }

  const TemporaryFolder folder_;
};

TEST_F(BagSurvey, ReadsEveryNumericField) {
  const Survey survey = surveyBag(robotBag());
  ASSERT_EQ(survey.streams.size(), 4u);
  EXPECT_EQ(survey.records, 1u);
  const Channel* left = find(survey, "/joint_states velocity[0]");
  ASSERT_NE(left, nullptr);
  EXPECT_EQ(left->topic, "/joint_states");
  EXPECT_EQ(left->field, "velocity[0]");
  EXPECT_EQ(left->records.front().values.size(), 600u);
  EXPECT_NEAR(left->records.front().stamps.front(), 9.999, 1e-9) << "the header's";
  const Channel* right = find(survey, "/joint_states velocity[1]");
  ASSERT_NE(right, nullptr);
  EXPECT_EQ(right->not_finite, 300);
  EXPECT_EQ(find(survey, "/joint_states velocity[2]"), nullptr);
  EXPECT_EQ(find(survey, "/joint_states effort[0]"), nullptr) << "an empty array";
  ASSERT_NE(find(survey, "/motor/command data"), nullptr);
  EXPECT_EQ(find(survey, "/rosout line"), nullptr) << "of the system";
  EXPECT_EQ(find(survey, "/scan ranges[0]"), nullptr) << "a long array";
  EXPECT_NE(find(survey, "/scan range_max"), nullptr);
  const SurveyedStream& command = survey.streams[1];
  EXPECT_EQ(command.name, "/motor/command");
  EXPECT_EQ(command.type, "std_msgs/Float64");
  EXPECT_NEAR(command.stamps.period, 0.02, 1e-6);
  EXPECT_TRUE(test::mentions(command.remark, "no header"));
}

TEST_F(BagSurvey, LeadsToAConfigurationThatReadsTheBag) {
  const std::string bag = robotBag();
  const InspectedData data = inspectData({bag}, {}, false);
  ASSERT_TRUE(data.choice.chosen) << data.choice.doubt;
  EXPECT_EQ(data.configuration.input.topic, "/motor/command");
  EXPECT_EQ(data.configuration.output.topic, "/joint_states");
  EXPECT_EQ(data.configuration.output.field, "velocity[0]");
  EXPECT_EQ(data.failure, "");
  EXPECT_EQ(data.loaded.experiments.size(), 6u) << "windows of 2 s";
  EXPECT_TRUE(test::mentions(inspectionYaml(data),
                             "output: {topic: \"/joint_states\", field: \"velocity[0]\"}"));
}

TEST_F(BagSurvey, KeepsWhatAConfigurationStates) {
  Configuration stated;
  stated.input.topic = "motor/command";  // field: auto
  stated.output.topic = "joint_states";
  stated.output.field = "joint_states.position[0]";
  const InspectedData data = inspectData({robotBag()}, stated, true);
  ASSERT_TRUE(data.choice.chosen);
  EXPECT_EQ(data.survey.channels[data.choice.chosen->output].field, "position[0]");
  EXPECT_EQ(data.choice.doubt, "");
  EXPECT_EQ(data.configuration.input.topic, "motor/command");
  EXPECT_EQ(data.configuration.output.field, "joint_states.position[0]");
  EXPECT_EQ(data.failure, "");
  stated.input.topic = "absent";
  EXPECT_TRUE(
      test::mentions(inspectData({robotBag()}, stated, true).failure, "no topic '/absent'"));
}

TEST_F(BagSurvey, TakesWholeExperiments) {
  Experiment experiment;
  experiment.id = "first";
  experiment.sample_time = 0.1;
  experiment.start_time = 1;
  experiment.u = Eigen::VectorXd::Random(40);
  experiment.y = Eigen::VectorXd::Random(40);
  const std::string bag = folder_ / "experiments.bag";
  writeBag(bag, {experiment});
  const InspectedData data = inspectData({bag}, {}, false);
  EXPECT_EQ(data.loaded.experiments.size(), 1u) << data.failure;
  std::string told;
  const Configuration by_names = configurationByNames({bag}, told);
  EXPECT_EQ(loadData({bag}, by_names).experiments.size(), 1u);
  EXPECT_EQ(told, "");
}

TEST_F(BagSurvey, WithoutConfigurationAsksWhereNamesLeaveADoubt) {
  std::string told;
  const std::string message =
      messageOf<ConfigurationError>([&] { configurationByNames({robotBag()}, told); });
  EXPECT_TRUE(test::mentions(message, "the output could be any of '/joint_states position[0]'"))
      << message;
  EXPECT_TRUE(test::mentions(message, "inspect --write C.yaml DATA...")) << message;
}

TEST_F(BagSurvey, RefusesWhatIsNoBag) {
  std::ofstream(folder_ / "text.bag") << "no bag";
  EXPECT_TRUE(test::mentions(messageOf<FileError>([&] { surveyData({folder_ / "text.bag"}, {}); }),
                             "is not a ROS bag"));
}

}  // namespace
}  // namespace uncertainty_identification
