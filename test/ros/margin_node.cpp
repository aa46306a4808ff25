// The node with models and weights whose margin is known by hand: K = 1/2 on Go = q^-1.

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <cmath>
#include <mutex>
#include <vector>

#include "io/read_file.h"
#include "ros/message_conversions.h"
#include "support/temporary_folder.h"
#include "support/wait_for.h"

namespace uncertainty_identification {
namespace {

using diagnostic_msgs::DiagnosticStatus;

constexpr double kSampleTime = 0.1;  // [s]

/// Go = q^-1, relative error N(0, 1/4).
Estimate plant() {
  Estimate estimate;
  estimate.nominal_model.sample_time = kSampleTime;
  estimate.nominal_model.delay = 1;
  estimate.nominal_model.b = Eigen::VectorXd::Ones(1);
  estimate.error_model.options.basis = BasisKind::fir;
  estimate.error_model.options.taps = 1;
  estimate.error_model.options.constraint = Constraint::free;
  estimate.error_model.T = Eigen::MatrixXd::Identity(1, 1);
  estimate.error_model.mixture = {
      {1}, {Eigen::VectorXd::Zero(1)}, {Eigen::MatrixXd::Constant(1, 1, 0.25)}};
  return estimate;
}

class MarginTest : public testing::Test {
 protected:
  MarginTest() : spinner_(1) {
    margin_subscriber_ = node_.subscribe<messages::RobustMargin>(
        "/robust_margin/margin", 100, [this](const messages::RobustMargin::ConstPtr& margin) {
          const std::lock_guard<std::mutex> lock(mutex_);
          margin_ = *margin;
        });
    diagnostics_ = node_.subscribe<diagnostic_msgs::DiagnosticArray>(
        "/diagnostics", 100, [this](const diagnostic_msgs::DiagnosticArray::ConstPtr& array) {
          const std::lock_guard<std::mutex> lock(mutex_);
          for (const auto& status : array->status) diagnosis_ = status;
          ++diagnoses_;
        });
    spinner_.start();
  }

  void SetUp() override {
    ASSERT_TRUE(waitFor([this] {
      return result_.getNumSubscribers() > 0 && bounds_.getNumSubscribers() > 0 &&
             margin_subscriber_.getNumPublishers() > 0;
    }));
  }

  void publishResult(std::uint32_t sequence) {
    ResultContext context;
    context.stamp = ros::Time::now().toNSec();
    context.sequence = sequence;
    result_.publish(toMessage(plant(), context));
  }

  void publishBounds(std::uint32_t sequence, const std::vector<double>& weight_num) {
    messages::UncertaintyBounds bounds;
    bounds.sequence = sequence;
    bounds.weight_level = 0.9;
    bounds.weight_num = weight_num;
    bounds.weight_den = {1};
    if (weight_num.empty()) bounds.warnings = {"the plants do not differ"};
    bounds_.publish(bounds);
  }

  messages::RobustMargin margin() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return margin_;
  }

  int diagnoses() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return diagnoses_;
  }

  DiagnosticStatus diagnosis() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return diagnosis_;
  }

  ros::NodeHandle node_;
  ros::Publisher result_ =
      node_.advertise<messages::IdentificationResult>("/identification/result", 1, true);
  ros::Publisher bounds_ =
      node_.advertise<messages::UncertaintyBounds>("/identification/uncertainty_bounds", 1, true);
  std::mutex mutex_;
  messages::RobustMargin margin_;
  DiagnosticStatus diagnosis_;
  int diagnoses_ = 0;
  ros::Subscriber margin_subscriber_, diagnostics_;
  ros::AsyncSpinner spinner_;
};

TEST_F(MarginTest, IsPublishedForAResultAndItsBounds) {
  publishBounds(2, {7});  // of a result before: not to be used
  publishResult(3);
  publishBounds(3, {0.8});
  ASSERT_TRUE(waitFor([this] { return margin().sequence == 3; }));
  const auto found = margin();
  EXPECT_NEAR(found.margin, 1.25, 1e-9);
  EXPECT_NEAR(found.peak, 0.8, 1e-9);
  EXPECT_NEAR(found.peak_omega, M_PI / kSampleTime, 1e-6);
  EXPECT_TRUE(found.nominal_stable);
  EXPECT_FALSE(found.lost);
  EXPECT_NEAR(found.unstable_probability, 0.5 * std::erfc(2 / std::sqrt(2.0)), 0.005);
  EXPECT_EQ(found.samples, 10000u);
  EXPECT_EQ(found.weight_level, 0.9);
  EXPECT_FALSE(found.estimation_errors_included);
  EXPECT_TRUE(waitFor([this] { return diagnosis().level == DiagnosticStatus::OK; }));
  const auto latched = ros::topic::waitForMessage<messages::RobustMargin>("/robust_margin/margin",
                                                                          node_, ros::Duration(60));
  ASSERT_TRUE(latched);
  EXPECT_EQ(latched->sequence, 3u);
}

TEST_F(MarginTest, ALostMarginIsAWarning) {
  publishResult(4);
  publishBounds(4, {1.6});
  ASSERT_TRUE(waitFor([this] { return margin().sequence == 4; }));
  EXPECT_NEAR(margin().margin, 1 / 1.6, 1e-9);
  EXPECT_TRUE(margin().lost);
  EXPECT_TRUE(waitFor([this] {
    return diagnosis().message.find("margin is lost") != std::string::npos;
  })) << diagnosis().message;
  EXPECT_EQ(diagnosis().level, DiagnosticStatus::WARN);
}

TEST_F(MarginTest, BoundsWithoutAWeightAreTold) {
  publishResult(5);
  publishBounds(5, {});
  EXPECT_TRUE(waitFor([this] {
    return diagnosis().message.find("the plants do not differ") != std::string::npos;
  })) << diagnosis().message;
  EXPECT_EQ(diagnosis().level, DiagnosticStatus::WARN);
}

TEST_F(MarginTest, DiagnosticsComeWhileTheClockStandsStill) {
  ASSERT_EQ(ros::Time::now(), ros::Time(0)) << "nobody publishes /clock";
  const int before = diagnoses();
  EXPECT_TRUE(waitFor([&] { return diagnoses() >= before + 3; }));
}

TEST(MarginParameters, BadOnesEndTheNodeWithAMessage) {
  using Polynomial = std::vector<double>;
  struct Case {
    std::string key, others;
    Polynomial den;
    std::string message;
  };
  const std::vector<Case> cases = {
      {"controller", "", {1, -1.2}, "a pole of magnitude 1.2"},
      {"controller", "", {0, 1}, "the first not zero"},
      {"controler", "", {1}, "did you mean controller?"},
      {"controller", "_minimum_margin:=0.5", {1}, "minimum_margin: found 0.5"}};
  for (const auto& [key, others, den, message] : cases) {
    const TemporaryFolder folder;
    const std::string log = folder / "log";
    ros::param::set("/broken/" + key + "/num", Polynomial{1});
    ros::param::set("/broken/" + key + "/den", den);
    const int status =
        std::system((std::string(TOOLS_FOLDER) + "/robust_margin_node __name:=broken " + others +
                     " > " + log + " 2>&1")
                        .c_str());
    ros::param::del("/broken");
    EXPECT_EQ(WIFEXITED(status) ? WEXITSTATUS(status) : -1, 2) << message;
    EXPECT_NE(readFile(log).find(message), std::string::npos) << readFile(log);
  }
}

}  // namespace
}  // namespace uncertainty_identification

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "margin_test");
  ros::NodeHandle node;
  return RUN_ALL_TESTS();
}
