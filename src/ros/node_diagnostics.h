#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <ros/node_handle.h>
#include <ros/wall_timer.h>

#include <functional>
#include <vector>

#include "ros/experiment_recorder.h"
#include "ros/identification_worker.h"

namespace uncertainty_identification {

/// Whether what is recorded arrives. STALE: input or output have never been heard; ERROR: the
/// same, or a silent output, while an experiment runs; WARN: any signal is silent, a covariate has
/// never been heard, or messages were left out. A topic is silent after three of its mean
/// intervals, and never before two seconds.
void diagnoseSignals(const std::vector<TopicActivity>& topics, bool experiment_runs,
                     diagnostic_updater::DiagnosticStatusWrapper& status);

/// How the last identification went. STALE: there was none yet; ERROR: it gave no usable result;
/// WARN: its result did not converge, or more than ten experiments wait.
void diagnoseIdentification(const WorkerStatus& worker,
                            diagnostic_updater::DiagnosticStatusWrapper& status);

/// How the samples of the newest experiment came. STALE: there is none; WARN: messages were lost.
void diagnoseTiming(const WorkerStatus& worker,
                    diagnostic_updater::DiagnosticStatusWrapper& status);

/// Publishes /diagnostics from the thread that spins, every ~diagnostic_period seconds of wall
/// time: a clock that stands still or goes back keeps none away.
class NodeDiagnostics {
 public:
  struct Sources {
    std::function<std::vector<TopicActivity>()> topics;
    std::function<bool()> experiment_runs;
    std::function<WorkerStatus()> worker;
  };

  NodeDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                  Sources sources);

  /// A further part of the node that tells how it is.
  void add(const std::string& name, const diagnostic_updater::TaskFunction& diagnose) {
    updater_.add(name, diagnose);
  }

 private:
  Sources sources_;
  diagnostic_updater::Updater updater_;
  ros::WallTimer timer_;
};

}  // namespace uncertainty_identification
