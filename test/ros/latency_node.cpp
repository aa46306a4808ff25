// How long the node takes to record a sample of 5 kHz signals, beside an idle worker, beside
// clients that attack the live page, and beside a worker that identifies. The rig is a process of
// its own. Run by scripts/measure_latency.

#include <gtest/gtest.h>
#include <std_srvs/Trigger.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <filesystem>
#include <map>
#include <thread>

#include "live/live_server.h"
#include "ros/experiment_bag.h"
#include "ros/identification_server.h"
#include "ros/parameters.h"
#include "support/example1.h"
#include "support/http_attack.h"
#include "support/node_client.h"
#include "support/quantile.h"
#include "support/shared_memory.h"
#include "support/temporary_folder.h"
#include "support/timed_queue.h"

namespace uncertainty_identification {
namespace {

using Clock = std::chrono::steady_clock;  // the same in both processes

constexpr double kPeriod = 1.0 / 5000;  // [s]
constexpr std::size_t kMostSamples = 1000000;

int seconds = 10;

/// What the rig is asked for, and when it published each sample.
struct Orders {
  std::atomic<int> wanted{0}, published{0};  // samples, since the start
  std::atomic<bool> stopping{false}, attacking{false};
  std::array<Clock::time_point, kMostSamples> times;
};

/// Attacks the live page while the orders say so.
void runAttacker(const Orders& orders, int port) {
  while (!orders.stopping) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (!orders.attacking) continue;
    const HttpAttack attack(port, 200, 1000000);
    while (orders.attacking) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::printf("hostile requests meanwhile: %d\n", attack.sent());
    std::fflush(stdout);
  }
}

void runRig(Orders& orders) {
  ros::NodeHandle node;
  ros::Publisher input = node.advertise<messages::Sample>("/actuator/command", 100000);
  ros::Publisher output = node.advertise<messages::Sample>("/sensor/measurement", 100000);
  waitFor([&] { return input.getNumSubscribers() > 0 && output.getNumSubscribers() > 0; });
  messages::Sample sample;
  auto due = Clock::now();
  while (!orders.stopping) {
    if (orders.published >= orders.wanted) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      due = Clock::now();
      continue;
    }
    std::this_thread::sleep_until(due);
    due += std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(kPeriod));
    sample.header.stamp = ros::Time::now();
    sample.value = (orders.published / 50) % 2;
    orders.times[static_cast<std::size_t>(orders.published)] = Clock::now();
    input.publish(sample);
    output.publish(sample);
    ++orders.published;
  }
}

/// What was measured of the callbacks of some seconds. [s]
struct Phase {
  std::vector<double> durations, latencies;
};

void print(const std::string& name, const Phase& phase) {
  std::printf("%-12s %9zu callbacks", name.c_str(), phase.durations.size());
  for (const auto* values : {&phase.durations, &phase.latencies}) {
    std::printf(" |");
    for (const double share : {0.5, 0.99, 0.999, 1.0})
      std::printf(" %8.1f", 1e6 * quantile(*values, share));
  }
  std::printf("\n");
}

void printRatio(const std::string& name, const Phase& phase, const Phase& idle) {
  std::printf("ratio of the latencies, %s to idle:", name.c_str());
  for (const double share : {0.5, 0.99, 0.999})
    std::printf(" %g %% %.2f", 100 * share,
                quantile(phase.latencies, share) / quantile(idle.latencies, share));
  std::printf("\n");
}

class LatencyTest : public testing::Test {
 protected:
  /// Records for some seconds, as one experiment.
  Phase record(NodeClient& client) {
    EXPECT_TRUE(client.call<std_srvs::Trigger>("start_experiment").success);
    phase_ = {};
    const int samples = static_cast<int>(seconds / kPeriod);
    for (auto* values : {&phase_.durations, &phase_.latencies})
      values->reserve(2 * static_cast<std::size_t>(samples));
    orders_.wanted += samples;
    EXPECT_TRUE(waitFor([&] { return handled_ >= 2 * orders_.wanted; }));
    EXPECT_TRUE(client.call<std_srvs::Trigger>("discard_experiment").success);
    return phase_;
  }

  void handle(const CallbackTimes& times) {
    const int sample = heard_[times.subscription]++;
    phase_.durations.push_back(times.duration());
    phase_.latencies.push_back(
        std::chrono::duration<double>(times.began - orders_.times[static_cast<std::size_t>(sample)])
            .count());
    ++handled_;
  }

  Orders& orders_ = sharedWithChildren<Orders>();
  std::map<const void*, int> heard_;  // samples of each topic
  std::atomic<int> handled_{0};
  Phase phase_;
};

TEST_F(LatencyTest, RecordingDoesNotWaitForTheWorker) {
  constexpr double kLongest = 1e-3;  // [s] of a callback, of 99.9 %
  const bool has_page = liveServerObstacle().empty();
  const int port = has_page ? freePort() : 0;
  const pid_t attacker = fork();
  if (attacker == 0) {
    runAttacker(orders_, port);
    _exit(0);
  }
  const pid_t rig = fork();
  int none = 0;
  if (rig == 0) {
    ros::init(none, nullptr, "rig", ros::init_options::NoSigintHandler);
    runRig(orders_);
    _exit(0);
  }
  const TemporaryFolder folder;
  ros::init(none, nullptr, "identification");
  ros::param::set("/identification/store_directory", folder.path());
  ros::param::set("/identification/live_page/port", port);
  Truth truth = loadTruth(std::string(PROJECT_FOLDER) + "/config/example1_truth.yaml");
  truth.experiments = 1000;  // to be identified for longer than a phase is recorded
  truth.samples = {2000};
  std::filesystem::create_directory(folder / "saved");
  const auto many = simulate(truth, 1);
  std::vector<const Experiment*> experiments;
  for (const auto& experiment : many) experiments.push_back(&experiment);
  writeExperimentBag(folder / "saved/many.bag", experiments);

  TimedQueue queue([this](const CallbackTimes& times) { handle(times); });
  ros::NodeHandle node, private_node("~");
  node.setCallbackQueue(&queue);
  private_node.setCallbackQueue(&queue);
  IdentificationServer server(node, private_node, loadParameters(private_node));
  std::atomic<bool> done{false};
  std::thread recording([&] {
    while (!done) queue.callAvailable(ros::WallDuration(0.01));
  });
  NodeClient client;
  const Phase idle = record(client);
  orders_.attacking = has_page;
  const Phase attacked = record(client);
  orders_.attacking = false;
  messages::Load::Request request;
  request.name = "many.bag";
  EXPECT_EQ(client.call<messages::Load>("load", request).added, many.size());
  const Phase busy = record(client);
  const bool identified = client.status().state == messages::IdentificationStatus::IDENTIFYING;
  done = true;
  recording.join();
  orders_.stopping = true;
  waitpid(rig, nullptr, 0);
  waitpid(attacker, nullptr, 0);

  std::printf(
      "[us] of two signals at 5 kHz: callback's own duration, and from publishing to its "
      "beginning, each 50 %%, 99 %%, 99.9 %%, longest\n");
  print("idle", idle);
  print("attacked", attacked);
  print("identifying", busy);
  printRatio("identifying", busy, idle);
  printRatio("attacked", attacked, idle);
  EXPECT_TRUE(identified) << "the worker was done before the measurement was";
  EXPECT_LT(quantile(attacked.durations, 0.999), kLongest);
  EXPECT_LT(quantile(busy.durations, 0.999), kLongest);
}

}  // namespace
}  // namespace uncertainty_identification

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (argc > 1) uncertainty_identification::seconds = std::stoi(argv[1]);
  return RUN_ALL_TESTS();
}
