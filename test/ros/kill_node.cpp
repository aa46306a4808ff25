// The node is killed at random moments while experiments stream in, and started again: what it
// acknowledged is there, once, as it was sent.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <map>
#include <random>
#include <thread>

#include "data/experiment_checks.h"
#include "ros/experiment_bag.h"
#include "ros/message_conversions.h"
#include "support/example1.h"
#include "support/node_client.h"
#include "support/node_process.h"
#include "support/temporary_folder.h"

namespace uncertainty_identification {
namespace {

namespace fs = std::filesystem;

constexpr double kSpacing = 100;  // [s] between the starts of experiments
int kills = 8;
std::uint64_t seed = 1;

/// Publishes experiments, each under an id and with a start of its own (the node counts none
/// twice), until it is stopped.
class Stream {
 public:
  Stream() {
    for (auto& experiment : example1Experiments(50)) messages_.push_back(toMessage(experiment));
  }

  ~Stream() { stop(); }

  void start() {
    stopping_ = false;
    thread_ = std::thread([this] {
      while (!stopping_) {
        auto message = messages_[sent_ % messages_.size()];
        message.header.stamp += ros::Duration(static_cast<double>(sent_) * kSpacing);
        message.id = "run_" + std::to_string(sent_++);
        publisher_.publish(message);
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
      }
    });
  }

  void stop() {
    stopping_ = true;
    if (thread_.joinable()) thread_.join();
  }

  bool isHeard() const { return publisher_.getNumSubscribers() > 0; }

  /// What was sent under an id.
  std::string fingerprintOf(const std::string& id) const {
    const std::size_t number = std::stoul(id.substr(std::string("run_").size()));
    return dataFingerprint({fromMessage(messages_[number % messages_.size()])});
  }

 private:
  ros::NodeHandle node_;
  ros::Publisher publisher_ =
      node_.advertise<messages::Experiment>("/identification/experiment", 10);
  std::vector<messages::Experiment> messages_;
  std::size_t sent_ = 0;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

/// The experiments on the disk: how often each, and that each is what was sent.
std::map<std::string, int> experimentsIn(const std::string& folder, const Stream& stream) {
  std::map<std::string, int> count;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() != ".bag") continue;
    const LoadedData data = readExperimentBag(entry.path());
    EXPECT_EQ(data.experiments.size(), 1U) << entry.path();
    for (const auto& experiment : data.experiments) {
      ++count[experiment.id];
      EXPECT_EQ(dataFingerprint({experiment}), stream.fingerprintOf(experiment.id));
    }
  }
  return count;
}

TEST(Kill, NothingAcknowledgedIsLostNothingIsThereTwiceOrTorn) {
  const TemporaryFolder folder;
  ros::param::set("/identification/store_directory", folder / "store");
  const std::string current = folder / "store/current";
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<unsigned> more(0, 40);  // experiments acknowledged before the kill
  std::uniform_int_distribution<int> delay(0, 50000);   // [us] after that
  Stream stream;
  std::uint32_t acknowledged = 0;
  for (int k = 0; k < kills; ++k) {
    NodeProcess node;
    messages::IdentificationStatus last;
    {
      NodeClient client;
      node.start();
      ASSERT_TRUE(client.waitForNode());
      EXPECT_EQ(client.status().stored_count, acknowledged) << "after kill " << k;
      ASSERT_TRUE(waitFor([&] { return stream.isHeard(); }));
      stream.start();
      const std::uint32_t wanted = acknowledged + more(random);
      ASSERT_TRUE(waitFor([&] { return client.status().stored_count >= wanted; }));
      std::this_thread::sleep_for(std::chrono::microseconds(delay(random)));
      node.kill();
      stream.stop();
      last = client.status();
    }
    ASSERT_TRUE(waitFor([&] { return !stream.isHeard(); }));
    if (!fs::exists(current)) continue;  // killed before the first one
    const auto stored = experimentsIn(current, stream);
    if (last.stored_count > 0) EXPECT_EQ(stored.count(last.last_stored_id), 1U) << "kill " << k;
    EXPECT_GE(stored.size(), last.stored_count) << "kill " << k;
    EXPECT_TRUE(std::all_of(stored.begin(), stored.end(),
                            [](const auto& each) { return each.second == 1; }));
    EXPECT_FALSE(fs::exists(current + "/damaged"));
    acknowledged = static_cast<std::uint32_t>(stored.size());
  }
  std::cout << kills << " kills, seed " << seed << ": " << acknowledged
            << " experiments stored, none lost, none twice, none torn\n";
}

}  // namespace
}  // namespace uncertainty_identification

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "kill_test");
  if (argc > 1) uncertainty_identification::kills = std::stoi(argv[1]);
  if (argc > 2) uncertainty_identification::seed = std::stoull(argv[2]);
  ros::NodeHandle node;
  return RUN_ALL_TESTS();
}
