#include "ros/node_diagnostics.h"

#include <algorithm>
#include <string>
#include <utility>

namespace uncertainty_identification {
namespace {

using Level = diagnostic_msgs::DiagnosticStatus;
using Status = diagnostic_updater::DiagnosticStatusWrapper;

// A topic is silent if nothing has arrived for this time, and for so many mean intervals.
constexpr double kShortestSilence = 2;  // [s]
constexpr double kMissedIntervals = 3;
constexpr int kLongQueue = 10;  // number of waiting experiments that is worth a warning

bool isSilent(const TopicActivity& topic) {
  return topic.role != TopicRole::marker && topic.messages > 0 &&
         topic.age > std::max(kShortestSilence, kMissedIntervals * topic.interval);
}

bool isMissing(const TopicActivity& topic) {
  return topic.role != TopicRole::marker && topic.messages == 0;
}

unsigned char levelOfMissing(TopicRole role, bool experiment_runs) {
  if (role == TopicRole::covariate) return Level::WARN;
  return experiment_runs ? Level::ERROR : Level::STALE;
}

unsigned char levelOfSilence(TopicRole role, bool experiment_runs) {
  return role == TopicRole::output && experiment_runs ? Level::ERROR : Level::WARN;
}

std::string nameOf(const TopicActivity& topic) { return topic.key + " (" + topic.topic + ")"; }

void summarise(const TopicActivity& topic, bool experiment_runs, Status& status) {
  if (isMissing(topic)) {
    status.mergeSummary(levelOfMissing(topic.role, experiment_runs),
                        "nothing has arrived on " + nameOf(topic) +
                            "; check that it is published and that its name is right");
  } else if (isSilent(topic)) {
    status.mergeSummaryf(levelOfSilence(topic.role, experiment_runs), "silence on %s for %.1f s",
                         nameOf(topic).c_str(), topic.age);
  }
  if (topic.not_finite > 0) {
    status.mergeSummaryf(Level::WARN, "%ld samples of %s were not finite (NaN or infinite)",
                         topic.not_finite, nameOf(topic).c_str());
  }
  if (topic.left_out > 0) {
    status.mergeSummaryf(Level::WARN, "%ld messages of %s were left out", topic.left_out,
                         nameOf(topic).c_str());
  }
}

}  // namespace

void diagnoseSignals(const std::vector<TopicActivity>& topics, bool experiment_runs,
                     Status& status) {
  status.summary(Level::OK, "");
  for (const auto& topic : topics) {
    summarise(topic, experiment_runs, status);
    status.addf(topic.key + " rate [Hz]", "%.4g", topic.rate);
    status.addf(topic.key + " age [s]", "%.3g", topic.age);
    status.add(topic.key + " messages", topic.messages);
    status.add(topic.key + " left out", topic.left_out);
    status.add(topic.key + " not finite", topic.not_finite);
  }
  if (status.level == Level::OK)
    status.message = experiment_runs ? "an experiment is being recorded" : "signals arrive";
}

void diagnoseIdentification(const WorkerStatus& worker, Status& status) {
  if (worker.failed) {
    status.summary(Level::ERROR, worker.message);
  } else if (worker.termination == Termination::not_run) {
    status.summary(Level::STALE, worker.message);
  } else if (worker.termination != Termination::converged) {
    status.summary(Level::WARN, worker.message);
  } else {
    status.summary(Level::OK, worker.message);
  }
  for (const std::string& reason : worker.trust.reasons)
    status.mergeSummary(Level::WARN, "do not rely on the bounds: " + reason);
  if (worker.queue > kLongQueue)
    status.mergeSummaryf(Level::WARN,
                         "%d experiments wait; they arrive faster than they can be "
                         "identified from",
                         worker.queue);
  status.add("termination", toString(worker.termination));
  status.addf("seconds [s]", "%.3g", worker.seconds);
  status.add("iterations", worker.iterations);
  status.add("queue", worker.queue);
  status.add("identifying", worker.busy);
  status.add("experiments", worker.stored);
  status.add("last experiment", worker.last_id);
}

void diagnoseActivity(const std::vector<Activity>& running, int waiting_requests, double now,
                      Status& status) {
  std::string all;
  for (const Activity& activity : running) {
    all += (all.empty() ? "" : "; ") + activity.what;
    status.addf(activity.what + " for [s]", "%.3g", std::max(0.0, now - activity.since));
  }
  status.summary(Level::OK, all.empty() ? "nothing is being computed" : all);
  status.add("waiting requests", waiting_requests);
}

void diagnoseStore(const StoreStatus& store, Status& status) {
  constexpr int kManyFiles = 100;
  status.summary(Level::OK, "experiments are stored");
  if (store.pending > kManyFiles)
    status.summaryf(Level::WARN, "%d files wait for the disk", store.pending);
  if (!store.message.empty()) status.summary(Level::ERROR, store.message);
  status.add("stored experiments", store.stored);
  status.add("waiting files", store.pending);
  status.add("files given up", store.lost);
}

void diagnoseTiming(const WorkerStatus& worker, Status& status) {
  if (worker.last_id.empty()) {
    status.summary(Level::STALE, "no experiment has finished yet");
    return;
  }
  status.summary(Level::OK, "experiment '" + worker.last_id + "'");
  const auto add = [&](const std::string& name, const SignalTiming& timing) {
    if (timing.lost > 0)
      status.mergeSummaryf(Level::WARN,
                           "%ld messages of the %s were lost; check the network, and the load and "
                           "the queue length of the publisher",
                           timing.lost, name.c_str());
    status.addf(name + " age of the newest sample [s]", "%.3g", timing.age);
    status.addf(name + " delay [s]", "%.3g", timing.delay);
    status.addf(name + " jitter [s]", "%.3g", timing.jitter);
    status.add(name + " lost", timing.lost);
  };
  add("input", worker.timing.input);
  add("output", worker.timing.output);
  status.addf("clock offset [s]", "%.3g", worker.timing.clockOffset());
}

NodeDiagnostics::NodeDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                                 Sources sources)
    : sources_(std::move(sources)), updater_(node, private_node) {
  updater_.setHardwareID("none");
  updater_.add("signals", [this](Status& status) {
    diagnoseSignals(sources_.topics(), sources_.experiment_runs(), status);
  });
  updater_.add("identification",
               [this](Status& status) { diagnoseIdentification(sources_.worker(), status); });
  updater_.add("timing", [this](Status& status) { diagnoseTiming(sources_.worker(), status); });
  timer_ = ros::NodeHandle(node).createWallTimer(
      ros::WallDuration(updater_.getPeriod()),
      [this](const ros::WallTimerEvent&) { updater_.force_update(); });
}

}  // namespace uncertainty_identification
