#include "ros/identify_request.h"

#include <gtest/gtest.h>
#include <ros/time.h>
#include <rosbag/bag.h>
#include <std_msgs/Bool.h>
#include <std_msgs/Float64.h>
#include <std_msgs/String.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "io/printable.h"
#include "io/read_file.h"
#include "ros/bag_writer.h"
#include "ros/message_conversions.h"
#include "support/example1.h"
#include "support/temporary_folder.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

using Request = messages::Identify::Request;
using IdentifyResponse = messages::Identify::Response;

class IdentifyRequestTest : public testing::Test {
 protected:
  void SetUp() override {
    ros::Time::init();
    own_.bag_directory = folder_.path();
  }

  IdentifyResponse answer(const Request& request) {
    return answerIdentify(request, own_, [](const Progress&) { return true; });
  }

  Request requestWith(const std::vector<Experiment>& experiments) {
    Request request;
    for (const auto& experiment : experiments) request.experiments.push_back(toMessage(experiment));
    return request;
  }

  TemporaryFolder folder_;
  Configuration own_ = example1Configuration();
};

TEST_F(IdentifyRequestTest, ExperimentsGiveWhatTheIdentifierGives) {
  const auto experiments = example1Experiments(10);
  const auto response = answer(requestWith(experiments));
  ASSERT_EQ(response.code, IdentifyResponse::OK) << response.message;
  const Estimate expected = Identifier(own_).identify(experiments);
  EXPECT_EQ(response.result.log_likelihood, expected.log_likelihood);
  EXPECT_EQ(response.result.nominal_model.b[0], expected.nominal_model.b[0]);
  EXPECT_EQ(response.result.experiment_count, 10U);
  EXPECT_EQ(response.result.window_start.toSec(), 1);
  EXPECT_EQ(nlohmann::json::parse(response.result.result_json)["experiments"]["count"], 10);
}

TEST_F(IdentifyRequestTest, WithoutAModelInTimeTheAnswerSaysSo) {
  own_.limits.max_request_time = 0.2;
  auto request = requestWith(example1Experiments(21));
  request.configuration = "{nominal_model: {nb: 50, na: 50, nc: 50, nd: 50}}";
  const auto response = answer(request);
  EXPECT_EQ(response.code, IdentifyResponse::NOT_USABLE);
  EXPECT_NE(response.message.find("time limit of 0.2 s"), std::string::npos) << response.message;
  request.experiments.resize(3);
  EXPECT_EQ(answer(request).code, IdentifyResponse::DATA_ERROR) << "300 samples, 200 parameters";
}

TEST_F(IdentifyRequestTest, NamesThatAreNoTextAreEscaped) {
  auto request = requestWith(example1Experiments(10));
  request.experiments[0].id = "run \xFF";
  request.experiments[1].id = "\xC0";
  request.experiments[1].sample_time = -1e300;
  const auto response = answer(request);
  ASSERT_EQ(response.code, IdentifyResponse::OK) << response.message;
  EXPECT_TRUE(isPrintable(response.result.window_first)) << response.result.window_first;
  const auto tree = nlohmann::json::parse(response.result.result_json);
  const std::string reason = tree["experiments"]["rejected"][0]["reason"];
  EXPECT_NE(reason.find("experiment '\\xC0': sample_time is -1e+300 s"), std::string::npos)
      << reason;
  request.experiments.clear();
  request.bags = {"\xFF.bag"};
  EXPECT_TRUE(isPrintable(answer(request).message)) << answer(request).message;
}

TEST_F(IdentifyRequestTest, BagsAreReadBelowTheDirectory) {
  writeBag(folder_ / "data.bag", example1Experiments(10));
  Request request;
  request.bags = {"data.bag"};
  const auto response = answer(request);
  ASSERT_EQ(response.code, IdentifyResponse::OK) << response.message;
  EXPECT_EQ(response.result.experiment_count, 10U);
}

TEST_F(IdentifyRequestTest, ConfigurationOfTheRequestCounts) {
  auto request = requestWith(example1Experiments(5));
  request.configuration =
      "{nominal_model: {structure: arx, nb: 1, na: 1, delay: 1}, error_model: {taps: 0}}";
  const auto response = answer(request);
  ASSERT_EQ(response.code, IdentifyResponse::OK) << response.message;
  EXPECT_EQ(response.result.nominal_model.structure, "arx");
  EXPECT_EQ(response.result.error_model.taps, 0U);
}

TEST_F(IdentifyRequestTest, EachFailureHasItsCode) {
  Request request;
  EXPECT_EQ(answer(request).code, IdentifyResponse::DATA_ERROR);
  request.configuration = "{nominal_modell: {}}";
  EXPECT_EQ(answer(request).code, IdentifyResponse::CONFIGURATION_ERROR);
  request.configuration = "{unclosed";
  EXPECT_EQ(answer(request).code, IdentifyResponse::CONFIGURATION_ERROR);
  request.configuration.clear();
  request.bags = {"../data.bag"};
  EXPECT_EQ(answer(request).code, IdentifyResponse::REFUSED);
  request.bags = {"absent.bag"};
  EXPECT_EQ(answer(request).code, IdentifyResponse::FILE_ERROR);
  std::ofstream(folder_ / "no.bag") << "no bag";
  request.bags = {"no.bag"};
  const auto response = answer(request);
  EXPECT_EQ(response.code, IdentifyResponse::FILE_ERROR);
  EXPECT_NE(response.message.find("is not a ROS bag"), std::string::npos) << response.message;
}

/// A bag of two megabytes that takes next to no room.
void writeBomb(const std::string& path) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  bag.setCompression(rosbag::compression::BZ2);
  std_msgs::String text;
  text.data.assign(2U << 20U, 'x');
  bag.write("/text", ros::Time(1), text);
  bag.write("/actuator/command", ros::Time(1), std_msgs::Float64());
  bag.write("/sensor/measurement", ros::Time(1), std_msgs::Float64());
  bag.write("/experiment/active", ros::Time(1), std_msgs::Bool());
  bag.close();
}

/// Makes a bag's first chunk say that it unpacks to `size` bytes.
void pretend(const std::string& path, std::uint32_t size) {
  std::string content = readFile(path);
  const std::string field = "size=";
  const auto found = content.find(field);
  ASSERT_NE(found, std::string::npos);
  std::memcpy(&content[found + field.size()], &size, sizeof size);
  std::ofstream(path, std::ios::binary) << content;
}

TEST_F(IdentifyRequestTest, BagsThatUnpackToMoreThanTheLimitAreRefused) {
  const std::string path = folder_ / "bomb.bag";
  writeBomb(path);
  Request request;
  request.bags = {"bomb.bag"};
  EXPECT_EQ(answer(request).code, IdentifyResponse::DATA_ERROR)
      << "it can be read, but marks nothing";
  own_.limits.max_bag_size = 1;
  ASSERT_LT(std::filesystem::file_size(path), 1U << 16U);
  request.configuration = "{nominal_model: {orders: auto}, limits: {max_bag_size: 100}}";
  const auto refused = answer(request);
  EXPECT_EQ(refused.code, IdentifyResponse::REFUSED);
  EXPECT_NE(refused.message.find("limits.max_bag_size"), std::string::npos) << refused.message;
  pretend(path, 0xffffffff);
  EXPECT_EQ(answer(request).code, IdentifyResponse::REFUSED);
  pretend(path, 1000);  // and expands to more
  EXPECT_EQ(answer(request).code, IdentifyResponse::FILE_ERROR);
  own_.limits.max_bag_size = 4096;  // no chunk may have more than 1024
  request.configuration.clear();
  pretend(path, 0x60000000);
  EXPECT_EQ(answer(request).code, IdentifyResponse::FILE_ERROR);
}

TEST_F(IdentifyRequestTest, RequestCannotOpenAnotherFolder) {
  own_.bag_directory.clear();
  Request request;
  request.bags = {"data.bag"};
  request.configuration = "{nominal_model: {orders: auto}, bag_directory: " + folder_.path() + "}";
  EXPECT_EQ(answer(request).code, IdentifyResponse::REFUSED);
}

TEST_F(IdentifyRequestTest, BadExperimentsAreListed) {
  auto request = requestWith(example1Experiments(6));
  request.experiments[2].y.pop_back();
  const auto response = answer(request);
  ASSERT_EQ(response.code, IdentifyResponse::OK) << response.message;
  EXPECT_EQ(response.result.experiment_count, 5U);
  const auto rejected =
      nlohmann::json::parse(response.result.result_json)["experiments"]["rejected"];
  ASSERT_EQ(rejected.size(), 1U);
  EXPECT_EQ(rejected[0]["id"], request.experiments[2].id);
}

TEST_F(IdentifyRequestTest, CancellingEndsReadingAndIdentifying) {
  const auto request = requestWith(example1Experiments(10));
  const auto response = answerIdentify(request, own_, [](const Progress&) { return false; });
  EXPECT_EQ(response.code, IdentifyResponse::CANCELLED) << response.message;

  writeBag(folder_ / "data.bag", example1Experiments(10));
  messages::IdentifyBagsGoal goal;
  goal.bags = {"data.bag"};
  std::set<std::string> phases;
  const auto until = [&](const std::string& last) {
    return answerIdentifyBags(goal, own_, [&phases, last](const Progress& progress) {
      phases.insert(progress.phase);
      return progress.phase != last;
    });
  };
  EXPECT_EQ(until("reading bags").code, messages::IdentifyBagsResult::CANCELLED);
  EXPECT_EQ(phases, std::set<std::string>{"reading bags"});
  EXPECT_EQ(until("optimising").code, messages::IdentifyBagsResult::CANCELLED);
  EXPECT_EQ(until("").code, messages::IdentifyBagsResult::OK);
}

}  // namespace
}  // namespace uncertainty_identification
