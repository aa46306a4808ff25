#include "ros/bag_survey.h"

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosgraph_msgs/Log.h>
#include <std_msgs/Float64.h>
#include <std_msgs/Float64MultiArray.h>

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
  /// A command without header and a robot's answers: joints by index, a scan, a log.
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
      std_msgs::Float64MultiArray joints;
      joints.data = {speed, k % 2 == 0 ? std::nan("") : -speed};
      bag.write("/joint_states", now, joints);
      std_msgs::Float64MultiArray scan;
      scan.data.assign(360, k);
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
  const Channel* left = find(survey, "/joint_states data[0]");
  ASSERT_NE(left, nullptr);
  EXPECT_EQ(left->topic, "/joint_states");
  EXPECT_EQ(left->field, "data[0]");
  EXPECT_EQ(left->records.front().values.size(), 600u);
  EXPECT_NEAR(left->records.front().stamps.front(), 10, 1e-9);
  const Channel* right = find(survey, "/joint_states data[1]");
  ASSERT_NE(right, nullptr);
  EXPECT_EQ(right->not_finite, 300);
  EXPECT_EQ(find(survey, "/joint_states data[2]"), nullptr);
  EXPECT_EQ(find(survey, "/joint_states layout.dim[0].size"), nullptr) << "an empty array";
  ASSERT_NE(find(survey, "/motor/command data"), nullptr);
  EXPECT_EQ(find(survey, "/rosout line"), nullptr) << "of the system";
  EXPECT_EQ(find(survey, "/scan data[0]"), nullptr) << "a long array";
  EXPECT_NE(find(survey, "/scan layout.data_offset"), nullptr);
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
  EXPECT_EQ(data.configuration.output.field, "data[0]");
  EXPECT_EQ(data.failure, "");
  EXPECT_EQ(data.loaded.experiments.size(), 6u) << "windows of 2 s";
  EXPECT_TRUE(test::mentions(inspectionYaml(data),
                             "output: {topic: \"/joint_states\", field: \"data[0]\"}"));
}

TEST_F(BagSurvey, KeepsWhatAConfigurationStates) {
  Configuration stated;
  stated.input.topic = "motor/command";  // field: auto
  stated.output.topic = "joint_states";
  stated.output.field = "joint_states.data[1]";
  const InspectedData data = inspectData({robotBag()}, stated, true);
  ASSERT_TRUE(data.choice.chosen);
  EXPECT_EQ(data.survey.channels[data.choice.chosen->output].field, "data[1]");
  EXPECT_EQ(data.choice.doubt, "");
  EXPECT_EQ(data.configuration.input.topic, "motor/command");
  EXPECT_EQ(data.configuration.output.field, "joint_states.data[1]");
  EXPECT_EQ(data.failure, "");
  stated.input.topic = "absent";
  EXPECT_TRUE(
      test::mentions(inspectData({robotBag()}, stated, true).failure, "no topic '/absent'"));
}

TEST_F(BagSurvey, TakesTheMarkersOfABag) {
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
  EXPECT_TRUE(test::mentions(told, "an experiment lasts while /experiment/active is true")) << told;
}

TEST_F(BagSurvey, WithoutConfigurationAsksWhereNamesLeaveADoubt) {
  std::string told;
  const std::string message =
      messageOf<ConfigurationError>([&] { configurationByNames({robotBag()}, told); });
  EXPECT_TRUE(test::mentions(message, "no signal that moves is called like an output")) << message;
  EXPECT_TRUE(test::mentions(message, "inspect --write C.yaml DATA...")) << message;
}

TEST_F(BagSurvey, RefusesWhatIsNoBag) {
  std::ofstream(folder_ / "text.bag") << "no bag";
  EXPECT_TRUE(test::mentions(messageOf<FileError>([&] { surveyData({folder_ / "text.bag"}, {}); }),
                             "is not a ROS bag"));
}

}  // namespace
}  // namespace uncertainty_identification
