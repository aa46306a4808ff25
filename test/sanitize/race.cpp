// What ThreadSanitizer must find in spite of test/tsan.supp: a value that a callback of roscpp
// writes while a worker's thread reads it. Compiled with -DPLANT_RACE nothing guards it; without, a
// mutex does and nothing may be found.

#include <gtest/gtest.h>
#include <ros/ros.h>
#include <std_msgs/Float64.h>

#include <mutex>
#include <thread>

#include "support/wait_for.h"

namespace {

constexpr double kLast = 100;

class Shared {
 public:
  void receive(const std_msgs::Float64::ConstPtr& message) {
    const auto lock = guard();
    value_ = message->data;
  }

  double value() {
    const auto lock = guard();
    return value_;
  }

 private:
  std::unique_lock<std::mutex> guard() {
#ifdef PLANT_RACE
    return {};
#else
    return std::unique_lock<std::mutex>(mutex_);
#endif
  }

  std::mutex mutex_;
  double value_ = 0;
};

TEST(Race, AWorkerReadsWhatACallbackWrites) {
  ros::NodeHandle node;
  Shared shared;
  const auto publisher = node.advertise<std_msgs::Float64>("race", 1000);
  const auto subscriber = node.subscribe("race", 1000, &Shared::receive, &shared);
  ros::AsyncSpinner spinner(1);
  spinner.start();
  ASSERT_TRUE(
      uncertainty_identification::waitFor([&] { return publisher.getNumSubscribers() > 0; }));
  std::thread worker([&] {
    EXPECT_TRUE(uncertainty_identification::waitFor([&] { return shared.value() == kLast; }));
  });
  std_msgs::Float64 message;
  while (message.data < kLast) {
    ++message.data;
    publisher.publish(message);
  }
  worker.join();
  spinner.stop();
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "race");
  return RUN_ALL_TESTS();
}
