// What the node keeps over its end, and the services that change it.

#include <gtest/gtest.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <future>

#include "ros/experiment_bag.h"
#include "ros/message_conversions.h"
#include "session/stored_result.h"
#include "support/example1.h"
#include "support/log_reader.h"
#include "support/node_client.h"
#include "support/node_process.h"
#include "support/temporary_folder.h"

namespace uncertainty_identification {
namespace {

namespace fs = std::filesystem;
using messages::Configure;
using messages::GetResult;
using messages::ListExperiments;
using messages::Load;
using messages::RejectExperiment;
using messages::Save;

class KeepingTest : public testing::Test {
 protected:
  void SetUp() override {
    ros::param::set("/identification/store_directory", store_);
    ros::param::set("/identification/error_model/components", 2);
    ros::param::set("/identification/limits/max_experiments", 1000);
    start();
  }

  void start() {
    client_ = std::make_unique<NodeClient>();
    node_.start();
    ASSERT_TRUE(client_->waitForNode());
    ASSERT_TRUE(waitFor([this] { return publisher_.getNumSubscribers() > 0; }));
  }

  void killAndStart() {
    client_.reset();
    node_.kill();
    ASSERT_TRUE(waitFor([this] { return publisher_.getNumSubscribers() == 0; }));
    start();
  }

  // Publishes experiments `first` to `last` and waits until the result rests on them.
  void publish(int first, int last) {
    const auto stored = client_->status().stored_count;
    const auto all = example1Experiments(last);
    for (int k = first - 1; k < last; ++k)
      publisher_.publish(toMessage(all[static_cast<std::size_t>(k)]));
    ASSERT_TRUE(client_->waitUntilStored(stored + static_cast<unsigned>(last - first + 1)))
        << client_->status().message;
  }

  messages::IdentificationResult result() { return client_->call<GetResult>("get_result").result; }

  std::vector<messages::ExperimentSummary> listed() {
    return client_->call<ListExperiments>("list_experiments").experiments;
  }

  Configure::Response configure(const std::string& text) {
    Configure::Request request;
    request.configuration = text;
    return client_->call<Configure>("configure", request);
  }

  Save::Response save(const std::string& name) {
    Save::Request request;
    request.name = name;
    return client_->call<Save>("save", request);
  }

  Load::Response load(const std::string& name) {
    Load::Request request;
    request.name = name;
    return client_->call<Load>("load", request);
  }

  const TemporaryFolder folder_;
  const std::string store_ = folder_ / "store";
  ros::NodeHandle handle_;
  ros::Publisher publisher_ =
      handle_.advertise<messages::Experiment>("/identification/experiment", 1000);
  NodeProcess node_;
  std::unique_ptr<NodeClient> client_;
};

TEST_F(KeepingTest, AKilledNodeGoesOnWhereItWas) {
  publish(1, 6);
  const auto before = result();
  EXPECT_FALSE(before.preliminary);
  EXPECT_EQ(before.window_count, 6U);
  EXPECT_EQ(before.window_last, example1Experiments(6).back().id);
  ASSERT_TRUE(waitFor([&] {
    return loadStoredResult(store_ + "/current/result.json").context.sequence == before.sequence;
  }));
  killAndStart();
  EXPECT_EQ(client_->status().stored_count, 6U);
  EXPECT_EQ(client_->status().last_stored_id, before.window_last);
  const auto after = result();
  EXPECT_EQ(after.sequence, before.sequence) << "nothing is new: no identification is needed";
  EXPECT_EQ(after.header.stamp, before.header.stamp);
  EXPECT_EQ(after.result_json, before.result_json);
  EXPECT_EQ(after.window_first, before.window_first);
  publish(7, 7);
  EXPECT_GT(result().sequence, before.sequence);
  EXPECT_EQ(result().experiment_count, 7U);
}

TEST_F(KeepingTest, ExperimentsOlderThanTheWindowStayOnTheDisk) {
  ros::param::set("/identification/limits/max_experiments", 4);
  killAndStart();
  publish(1, 6);
  const auto check = [this] {
    EXPECT_EQ(client_->status().stored_count, 6U);
    EXPECT_EQ(listed().size(), 4U);
    EXPECT_EQ(result().window_count, 4U);
    EXPECT_EQ(result().window_first, example1Experiments(3).back().id);
  };
  check();
  killAndStart();
  check();
}

TEST_F(KeepingTest, DamagedFilesAreMovedAside) {
  publish(1, 5);
  fs::resize_file(store_ + "/current/experiment_00000002.bag", 2000);
  std::ofstream(store_ + "/current/experiment_00000005.bag.tmp.1.1") << "half a file";
  killAndStart();
  ASSERT_TRUE(client_->waitUntilStored(4));
  EXPECT_EQ(listed().size(), 4U);
  EXPECT_EQ(result().experiment_count, 4U);
  EXPECT_TRUE(fs::exists(store_ + "/current/damaged/experiment_00000002.bag.txt"));
  EXPECT_FALSE(fs::exists(store_ + "/current/experiment_00000005.bag.tmp.1.1"));
}

TEST_F(KeepingTest, RejectedExperimentsStayRejected) {
  publish(1, 6);
  RejectExperiment::Request request;
  request.id = "nobody";
  EXPECT_EQ(client_->call<RejectExperiment>("reject_experiment", request).code,
            RejectExperiment::Response::NOT_FOUND);
  request.id = listed()[2].id;
  request.reason = "the rig was touched";
  EXPECT_EQ(client_->call<RejectExperiment>("reject_experiment", request).code,
            RejectExperiment::Response::OK);
  ASSERT_TRUE(waitFor([this] { return result().experiment_count == 5; }));
  ASSERT_TRUE(waitFor([this] { return client_->status().stored_count == 5; }));
  killAndStart();
  const auto list = listed();
  ASSERT_EQ(list.size(), 6U);
  EXPECT_EQ(list.back().id, request.id);
  EXPECT_EQ(list.back().rejected, request.reason);
  EXPECT_EQ(result().experiment_count, 5U);
}

TEST_F(KeepingTest, ConfigureIdentifiesAnewOrKeepsTheOld) {
  publish(1, 8);
  const auto before = result();
  const std::string one =
      "{nominal_model: {nb: 1, na: 1, nc: 1, nd: 1, delay: 1}, "
      "error_model: {components: 1}}";
  const auto answer = configure(one);
  ASSERT_EQ(answer.code, Configure::Response::OK) << answer.message;
  const auto after = result();
  EXPECT_EQ(after.sequence, answer.sequence);
  EXPECT_GT(after.sequence, before.sequence);
  EXPECT_EQ(after.error_model.components.size(), 1U);
  EXPECT_EQ(after.experiment_count, 8U);

  const std::vector<std::pair<std::string, std::uint8_t>> wrong = {
      {"{", Configure::Response::CONFIGURATION_ERROR},
      {"", Configure::Response::CONFIGURATION_ERROR},
      {"{nominal_model: {nb: 0}}", Configure::Response::CONFIGURATION_ERROR},
      {"{store_directory: /tmp}", Configure::Response::REFUSED},
      {"{input: {topic: elsewhere}}", Configure::Response::REFUSED},
      {"{limits: {max_experiments: 1001}}", Configure::Response::REFUSED},
      {"{limits: {max_samples: 1000001}}", Configure::Response::REFUSED},
      {"{limits: {max_request_size: 257}}", Configure::Response::REFUSED},
      {"{limits: {max_bag_size: 4097}}", Configure::Response::REFUSED},
      {"{limits: {max_saved_files: 101}}", Configure::Response::REFUSED},
      {"{nominal_model: {nb: 50, na: 50, nc: 50, nd: 50}}", Configure::Response::DATA_ERROR}};
  for (const auto& [text, code] : wrong) {
    const auto refused = configure(text);
    EXPECT_EQ(refused.code, code) << text << ": " << refused.message;
    EXPECT_FALSE(refused.message.empty());
    EXPECT_EQ(result().sequence, after.sequence);
  }
  EXPECT_EQ(configure(after.configuration).code, Configure::Response::OK)
      << "what a result says can be sent back";
}

// ~configure holds over a restart as long as the parameters are the same.
TEST_F(KeepingTest, ParametersWinOverConfigureOnceTheyChange) {
  publish(1, 8);
  ASSERT_EQ(configure("{nominal_model: {nb: 1, na: 1, nc: 1, nd: 1, delay: 1}, "
                      "error_model: {components: 1}}")
                .code,
            Configure::Response::OK);
  ASSERT_TRUE(waitFor([this] { return fs::exists(store_ + "/configuration.json"); }));
  killAndStart();
  publish(9, 9);
  EXPECT_EQ(result().error_model.components.size(), 1U);
  ros::param::set("/identification/error_model/components", 3);
  killAndStart();
  ASSERT_TRUE(waitFor([this] { return result().error_model.components.size() == 3; }))
      << client_->status().message;
}

TEST_F(KeepingTest, SavedExperimentsCanBeLoaded) {
  EXPECT_EQ(save("early.bag").code, Save::Response::NONE_YET);
  publish(1, 5);
  const auto saved = save("today.bag");
  ASSERT_EQ(saved.code, Save::Response::OK) << saved.message;
  EXPECT_EQ(saved.experiments, 5U);
  EXPECT_EQ(readExperimentBag(saved.path).experiments.size(), 5U);
  for (const std::string name : {"today.bag", "../a.bag", "/tmp/a.bag", "a.txt", "", "a b.bag"})
    EXPECT_EQ(save(name).code, Save::Response::REFUSED) << name;

  const auto known = load("today.bag");
  EXPECT_EQ(known.code, Load::Response::OK) << known.message;
  EXPECT_EQ(known.added, 0U);
  EXPECT_EQ(known.known, 5U);
  RejectExperiment::Request reject;
  reject.id = listed()[1].id;
  ASSERT_EQ(client_->call<RejectExperiment>("reject_experiment", reject).code,
            RejectExperiment::Response::OK);
  EXPECT_EQ(load("today.bag").added, 1U) << "what was rejected comes back on request";
  ASSERT_TRUE(client_->waitUntilStored(5));
  ASSERT_TRUE(client_->call<std_srvs::Trigger>("reset").success);
  EXPECT_EQ(load("today.bag").added, 5U);
  ASSERT_TRUE(client_->waitUntilStored(5));
  EXPECT_EQ(listed().size(), 5U);

  fs::create_symlink("/etc/passwd", store_ + "/saved/link.bag");
  fs::create_directory(store_ + "/saved/folder.bag");
  std::ofstream(store_ + "/saved/broken.bag") << "no bag";
  EXPECT_EQ(load("link.bag").code, Load::Response::REFUSED);
  EXPECT_EQ(load("../configuration.json").code, Load::Response::REFUSED);
  EXPECT_EQ(load("folder.bag").code, Load::Response::FILE_ERROR);
  EXPECT_EQ(load("broken.bag").code, Load::Response::FILE_ERROR);
  EXPECT_EQ(load("none.bag").code, Load::Response::FILE_ERROR);
}

TEST_F(KeepingTest, ResetPutsTheStoreAside) {
  publish(1, 3);
  ASSERT_TRUE(client_->call<std_srvs::Trigger>("reset").success);
  ASSERT_TRUE(waitFor([this] { return client_->status().stored_count == 0; }));
  EXPECT_TRUE(fs::exists(store_ + "/reset_1/experiment_00000003.bag"));
  killAndStart();
  EXPECT_TRUE(listed().empty());
  EXPECT_EQ(client_->call<GetResult>("get_result").code, GetResult::Response::NONE_YET);
}

// As when a disk is unplugged and plugged in again.
TEST_F(KeepingTest, WithoutItsDiskTheNodeGoesOnInMemory) {
  using rosgraph_msgs::Log;
  const LogReader log;
  int stored = 4;
  publish(1, stored);
  for (; log.count(Log::INFO, "was accepted") == 0 && stored < 100; ++stored)
    publish(stored + 1, stored + 1);  // lines before the reader was connected are not heard
  fs::rename(store_, folder_ / "away");
  const auto number = static_cast<unsigned>(stored);
  const auto all = example1Experiments(stored + 2);
  publisher_.publish(toMessage(all[number]));
  publisher_.publish(toMessage(all[number + 1]));
  ASSERT_TRUE(waitFor([&] { return result().experiment_count == number + 2; }));
  ASSERT_TRUE(
      waitFor([this] { return client_->status().state == messages::IdentificationStatus::ERROR; }));
  EXPECT_NE(client_->status().store_problem.find("wait in memory"), std::string::npos);
  EXPECT_EQ(client_->status().stored_count, number) << "not on the disk, so not acknowledged";
  ASSERT_TRUE(waitFor([&] { return log.count(Log::ERROR, "") == 1; }));
  EXPECT_TRUE(waitFor([&] { return log.count(Log::INFO, all[number + 1].id) >= 1; }));
  EXPECT_TRUE(waitFor([&] { return log.count(Log::INFO, "(before ") >= 1; }));
  fs::rename(folder_ / "away", store_);
  ASSERT_TRUE(waitFor([&] { return client_->status().stored_count == number + 2; }));
  EXPECT_TRUE(
      waitFor([this] { return client_->status().state == messages::IdentificationStatus::IDLE; }));
  EXPECT_TRUE(waitFor([&] { return log.count(Log::ERROR, "again") == 1; }));
  EXPECT_EQ(log.count(Log::ERROR, ""), 2);
}

TEST_F(KeepingTest, WhatWaitsIsWrittenWhenTheNodeIsStopped) {
  const auto all = example1Experiments(20);
  for (const auto& experiment : all) publisher_.publish(toMessage(experiment));
  ASSERT_TRUE(waitFor([this] { return !listed().empty(); }));
  const std::size_t known = listed().size();
  node_.interrupt();
  std::size_t bags = 0;
  for (const auto& entry : fs::directory_iterator(store_ + "/current"))
    bags += entry.path().extension() == ".bag" ? 1 : 0;
  EXPECT_GE(bags, known);
}

TEST_F(KeepingTest, WhatCouldNotBeWrittenIsNamedWhenTheNodeIsStopped) {
  publish(1, 2);
  fs::rename(store_, folder_ / "away");
  const Experiment last = example1Experiments(3).back();
  publisher_.publish(toMessage(last));
  ASSERT_TRUE(waitFor([this] { return !client_->status().store_problem.empty(); }));
  const std::string logged = node_.interrupt().errors;
  EXPECT_NE(logged.find("lost: experiment '" + last.id + "'"), std::string::npos) << logged;
  fs::rename(folder_ / "away", store_);
}

// The largest orders that a configuration may have: minutes of work, if nobody stops it.
TEST_F(KeepingTest, AnInterruptEndsTheLargestRequestAtOnce) {
  publish(1, 25);
  auto answer = std::async(std::launch::async, [this] {
    EXPECT_THROW(configure("{nominal_model: {nb: 50, na: 50, nc: 50, nd: 50, delay: 1}}"),
                 std::runtime_error)
        << "the node ends before it can answer";
  });
  ASSERT_TRUE(waitFor([this] {
    const auto running = client_->status().running;
    return std::count(running.begin(), running.end(), "answering ~configure") == 1;
  }));
  const auto began = std::chrono::steady_clock::now();
  node_.interrupt();
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(5));
  answer.wait();
}

}  // namespace
}  // namespace uncertainty_identification

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "keeping_test");
  ros::NodeHandle node;
  return RUN_ALL_TESTS();
}
