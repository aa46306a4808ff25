// Topics without headers, as a robot's command and odometry, on simulated time and cut by duration.

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <std_msgs/Float64MultiArray.h>

#include <random>

#include "ros/parameters.h"
#include "support/node_client.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/ros/bag_reader.h"

namespace uncertainty_identification {
namespace {

constexpr double kPeriod = 0.02;  // [s]
constexpr double kPole = 0.9;     // of a system with gain 1

// 9 s at 50 Hz; commands are held for 10 samples, so that a shift by one sample hardly matters.
// With noise: of data that a model fits without error no noise variance can be estimated.
void writeDrive(const std::string& path) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  std::mt19937_64 engine(1);
  std_msgs::Float64MultiArray command, odometry;
  command.data = {0};
  odometry.data = {0, 0};
  double speed = 0;
  std::normal_distribution<double> noise(0, 0.005);
  for (int k = 0; k < 450; ++k) {
    const ros::Time stamp(100 + k * kPeriod);
    speed = kPole * speed + (1 - kPole) * command.data[0];
    odometry.data[1] = speed + noise(engine);
    if (k % 10 == 0) command.data[0] = engine() % 2 == 0 ? 0.5 : -0.5;
    bag.write("/cmd_vel", stamp, command);
    bag.write("/odom", stamp, odometry);
  }
  bag.close();
}

TEST(Headerless, DurationCutsTheReplayAndTheNodeWarns) {
  const TemporaryFolder folder;
  const std::string bag = folder / "drive.bag";
  writeDrive(bag);
  NodeClient client;
  ASSERT_TRUE(client.waitForNode());
  ASSERT_EQ(playBag(bag, "--hz=1000"), 0);
  ASSERT_TRUE(client.waitUntilStored(4)) << client.told();
  EXPECT_NE(client.told().find("'/cmd_vel' has no header"), std::string::npos) << client.told();

  const auto offline = readBag(bag, loadParameters(client.node()));
  ASSERT_EQ(offline.experiments.size(), 5U);
  const auto list = client.call<messages::ListExperiments>("list_experiments").experiments;
  ASSERT_EQ(list.size(),
            4U);  // the last window is still open: nothing tells that the clock will not go on
  for (std::size_t i = 0; i < list.size(); ++i) {
    EXPECT_NEAR(list[i].start.toSec(), offline.experiments[i].start_time, 0.05);
    EXPECT_NEAR(list[i].samples, 100, 2);
  }
  const auto answer = client.call<messages::GetResult>("get_result");
  ASSERT_EQ(answer.code, messages::GetResult::Response::OK) << answer.message;
  const auto& model = answer.result.nominal_model;
  EXPECT_NEAR(model.b.at(0) / (1 + model.a.at(0)), 1, 0.1);
  EXPECT_NEAR(model.a.at(0), -kPole, 0.05);
}

}  // namespace
}  // namespace uncertainty_identification

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "headerless_test");
  ros::NodeHandle node;
  return RUN_ALL_TESTS();
}
