// The node over many experiments in simulated time, one every 4.32 s (20000 are a day): its memory
// and the latency of its callbacks do not grow. The rig is a process of its own.

#include <gtest/gtest.h>
#include <rosgraph_msgs/Clock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "ros/identification_server.h"
#include "ros/parameters.h"
#include "support/example1.h"
#include "support/quantile.h"
#include "support/resident_memory.h"
#include "support/shared_memory.h"
#include "support/temporary_folder.h"
#include "support/timed_queue.h"
#include "support/wait_for.h"

namespace uncertainty_identification {
namespace {

constexpr double kInterval = 4.32;    // [s] from experiment to experiment
constexpr double kSampleTime = 0.17;  // [s]
constexpr int kSamples = 25;
constexpr int kMostAhead = 20;  // experiments that the rig may be ahead of the store

int experiments = 400;

/// How far both processes are.
struct Progress {
  std::atomic<int> published{0}, stored{0};
};

class Rig {
 public:
  explicit Rig(Progress& progress) : progress_(progress) {}

  void run() {
    waitFor([this] {
      return input_.getNumSubscribers() > 0 && output_.getNumSubscribers() > 0 &&
             marker_.getNumSubscribers() > 0;
    });
    const auto data = example1Experiments(200);
    for (int k = 0; k < experiments; ++k) {
      publish(k, data[static_cast<std::size_t>(k) % data.size()]);
      ++progress_.published;
      while (progress_.published - progress_.stored > kMostAhead)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    waitFor([this] { return progress_.stored >= experiments; });
  }

 private:
  void publish(int number, const Experiment& experiment) {
    const double begin = 1 + number * kInterval;
    mark(begin, number, true);
    messages::Sample sample;
    for (int k = 0; k < kSamples; ++k) {
      rosgraph_msgs::Clock now;
      now.clock = sample.header.stamp = ros::Time(begin + k * kSampleTime);
      clock_.publish(now);
      sample.value = experiment.u[k];
      input_.publish(sample);
      sample.value = experiment.y[k];
      output_.publish(sample);
    }
    mark(begin + kSamples * kSampleTime, number, false);
  }

  void mark(double stamp, int number, bool active) {
    messages::ExperimentMarker marker;
    marker.header.stamp = ros::Time(stamp);
    marker.id = "run_" + std::to_string(number);
    marker.active = active;
    marker_.publish(marker);
  }

  Progress& progress_;
  ros::NodeHandle node_;
  ros::Publisher clock_ = node_.advertise<rosgraph_msgs::Clock>("/clock", 1000);
  ros::Publisher input_ = node_.advertise<messages::Sample>("/actuator/command", 10000);
  ros::Publisher output_ = node_.advertise<messages::Sample>("/sensor/measurement", 10000);
  ros::Publisher marker_ = node_.advertise<messages::ExperimentMarker>("/experiment/active", 1000);
};

/// Slope of y over x by least squares.
double slope(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double mx = 0, my = 0, xx = 0, xy = 0;
  for (std::size_t k = 0; k < x.size(); ++k) mx += x[k] / n, my += y[k] / n;
  for (std::size_t k = 0; k < x.size(); ++k) {
    xx += (x[k] - mx) * (x[k] - mx);
    xy += (x[k] - mx) * (y[k] - my);
  }
  return xy / xx;
}

std::vector<double> part(const std::vector<double>& all, double from, double to) {
  const auto at = [&](double share) {
    return all.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(all.size()));
  };
  return {at(from), at(to)};
}

TEST(Soak, NeitherMemoryNorLatencyGrows) {
  constexpr double kWarmUp = 0.3;   // share of the run
  constexpr double kGrowth = 0.03;  // share of the memory at most, over the rest of the run
  constexpr double kSlower = 3;     // the callbacks at the end; a time that grows with the number
                                    // of experiments is 4.8 times as long there
  constexpr double kUnnoticed = 1e-3;  // [s] of waiting
  const TemporaryFolder folder;

  // What is recorded here must not grow either: the room is taken beforehand.
  std::vector<double> waited(static_cast<std::size_t>(experiments) * (2 * kSamples + 2), 0.0);
  std::vector<double> computed = waited;
  std::vector<double> at(1000, 0.0), memory(1000, 0.0);
  std::size_t callbacks = 0, points = 0;
  Progress& progress = sharedWithChildren<Progress>();
  const pid_t rig = fork();
  if (rig == 0) {
    int none = 0;
    ros::init(none, nullptr, "rig", ros::init_options::NoSigintHandler);
    ros::NodeHandle keep;
    Rig(progress).run();
    _exit(0);
  }
  int none = 0;
  ros::init(none, nullptr, "identification");
  ros::param::set("/identification/store_directory", folder / "store");
  TimedQueue queue([&](const CallbackTimes& times) {
    if (callbacks == waited.size()) return;
    waited[callbacks] = times.waited() + times.duration();
    computed[callbacks++] = times.computed;
  });
  ros::NodeHandle node, private_node("~");
  node.setCallbackQueue(&queue);
  private_node.setCallbackQueue(&queue);
  ros::AsyncSpinner clock(1);  // the clock and the status have the global queue
  clock.start();
  const auto status = ros::NodeHandle().subscribe<messages::IdentificationStatus>(
      "/identification/status", 100, [&](const messages::IdentificationStatus::ConstPtr& message) {
        progress.stored = static_cast<int>(message->stored_count);
      });
  IdentificationServer server(node, private_node, loadParameters(private_node));
  int reached = 0;
  while (waitpid(rig, nullptr, WNOHANG) == 0) {
    queue.callAvailable(ros::WallDuration(0.05));
    if (progress.stored * static_cast<int>(at.size()) < reached * experiments ||
        points == at.size())
      continue;
    at[points] = progress.stored;
    memory[points++] = residentMemory(getpid());
    reached = progress.stored * static_cast<int>(at.size()) / experiments + 1;
  }
  at.resize(points);
  memory.resize(points);
  ASSERT_EQ(progress.stored, experiments);
  ASSERT_EQ(callbacks, waited.size()) << "messages were lost";
  const auto later = part(memory, kWarmUp, 1);
  const double growth = slope(part(at, kWarmUp, 1), later) * (1 - kWarmUp) * experiments;
  const auto early = [&](const auto& all) { return part(all, 0.15, 0.25); };
  const auto late = [&](const auto& all) { return part(all, 0.9, 1); };
  std::printf("%d experiments, %.1f h simulated\n", experiments, experiments * kInterval / 3600);
  std::printf(
      "resident memory: %.1f MB after warm-up, %.1f MB at the end, slope %.3f MB per 1000 "
      "experiments\n",
      later.front(), later.back(), 1000 * growth / ((1 - kWarmUp) * experiments));
  const auto print = [&](const char* what, const std::vector<double>& all) {
    std::printf(
        "%s, median and 99 %%: %.1f and %.1f us at the beginning, %.1f and %.1f us at the end\n",
        what, 1e6 * quantile(early(all), 0.5), 1e6 * quantile(early(all), 0.99),
        1e6 * quantile(late(all), 0.5), 1e6 * quantile(late(all), 0.99));
  };
  print("from arrival to the end of the callback", waited);
  print("callback's processor time", computed);
  EXPECT_LT(growth, kGrowth * later.front());
  // The longest waits are a busy machine's and judged by nobody; processor time is the node's own.
  EXPECT_LT(quantile(late(waited), 0.5),
            std::max(kUnnoticed, kSlower * quantile(early(waited), 0.5)));
  EXPECT_LT(quantile(late(computed), 0.99), kSlower * quantile(early(computed), 0.99));
}

}  // namespace
}  // namespace uncertainty_identification

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (argc > 1) uncertainty_identification::experiments = std::stoi(argv[1]);
  return RUN_ALL_TESTS();
}
