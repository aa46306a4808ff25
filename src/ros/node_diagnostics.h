#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/wall_timer.h>

#include <functional>
#include <vector>

#include "ros/experiment_recorder.h"
#include "session/activities.h"
#include "session/identification_worker.h"
#include "session/store_writer.h"

namespace uncertainty_identification {

/// Diagnostics of the recorded signals. STALE: nothing has ever arrived on the input or the output.
/// ERROR: the same, or the output is silent, while an experiment is running. WARN: a signal is
/// silent, nothing has ever arrived for a covariate, or messages were left out. A topic is silent
/// if nothing has arrived for three of its mean intervals, and for at least two seconds.
void diagnoseSignals(const std::vector<TopicActivity>& topics, bool experiment_runs,
                     diagnostic_updater::DiagnosticStatusWrapper& status);

/// Diagnostics of the last identification. STALE: there was none yet. ERROR: it gave no usable
/// result. WARN: it did not converge, or more than ten experiments are waiting.
void diagnoseIdentification(const WorkerStatus& worker,
                            diagnostic_updater::DiagnosticStatusWrapper& status);

/// Diagnostics of the timing of the newest experiment. STALE: there is none yet. WARN: messages
/// were lost.
void diagnoseTiming(const WorkerStatus& worker,
                    diagnostic_updater::DiagnosticStatusWrapper& status);

/// What is computed, since when, and how many requests wait for it. Always OK.
void diagnoseActivity(const std::vector<Activity>& running, int waiting_requests, double now,
                      diagnostic_updater::DiagnosticStatusWrapper& status);

/// Diagnostics of the store. ERROR: the disk refuses, or files were given up. WARN: more than a
/// hundred files wait for the disk.
void diagnoseStore(const StoreStatus& store, diagnostic_updater::DiagnosticStatusWrapper& status);

/// Publishes /diagnostics from the thread that spins, every ~diagnostic_period seconds of wall
/// time. Wall time is used so that diagnostics continue when the simulated clock stops or goes
/// back.
class NodeDiagnostics {
 public:
  struct Sources {
    std::function<std::vector<TopicActivity>()> topics;
    std::function<bool()> experiment_runs;
    std::function<WorkerStatus()> worker;
  };

  NodeDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                  Sources sources);

  /// Adds the diagnostics of a further part of the node.
  void add(const std::string& name, const diagnostic_updater::TaskFunction& diagnose) {
    updater_.add(name, diagnose);
  }

 private:
  Sources sources_;
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

}  // namespace uncertainty_identification
