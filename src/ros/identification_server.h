#pragma once

#include <ros/node_handle.h>
#include <std_srvs/Trigger.h>

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "ros/action_thread.h"
#include "ros/bounds_publisher.h"
#include "ros/experiment_recorder.h"
#include "ros/explanation_server.h"
#include "ros/identification_worker.h"
#include "ros/messages.h"
#include "ros/node_diagnostics.h"
#include "ros/reconfiguration.h"
#include "ros/report_writer.h"
#include "ros/result_publisher.h"
#include "ros/saved_experiments.h"
#include "ros/service_thread.h"
#include "ros/status_publisher.h"
#include "ros/store_writer.h"
#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

/// The node: topics to experiments (ExperimentRecorder), experiments to results
/// (IdentificationWorker), results to topics (ResultPublisher, BoundsPublisher, StatusPublisher),
/// both to the disk (StoreWriter), explanations (ExplanationServer), and services.
/// Topics and ~start_experiment, ~finish_experiment, ~discard_experiment, ~reset are served by the
/// thread that spins; ~identify and ~configure by one thread, the action ~identify_bags by two, the
/// other services by another, so that no request keeps a sample from being recorded, or a quick one
/// from being answered.
class IdentificationServer {
 public:
  /// Goes on from what the store holds, where there is one. Throws ConfigurationError when the
  /// configuration is not valid, or the store cannot be opened.
  IdentificationServer(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                       const Configuration& parameters);

  /// Cancels what is running.
  ~IdentificationServer();

 private:
  using Trigger = std_srvs::Trigger;

  IdentificationWorker::Listener workerListener();
  WorkerStatus workerStatus() const;
  void restore();
  void advertiseKeeping();
  void advertiseTriggers(ros::NodeHandle node);
  void advertiseRequests();
  void advertiseTrigger(ros::NodeHandle& node, const std::string& name,
                        const std::function<Trigger::Response()>& answer);
  Trigger::Response reset();
  messages::GetResult::Response getResult() const;
  messages::ListExperiments::Response listExperiments() const;
  messages::RejectExperiment::Response rejectExperiment(
      const messages::RejectExperiment::Request& request);
  messages::WriteReport::Response writeReport(const messages::WriteReport::Request& request) const;

  std::atomic<bool> stopping_{false};
  ResultPublisher results_;
  ExplanationServer explanations_;
  ReportWriter reports_;
  BoundsPublisher bounds_;
  StatusPublisher status_;
  std::unique_ptr<StoreWriter> store_;  // null: nothing is stored
  StoredState stored_;                  // what it held; empty once the worker has it
  const Configuration configuration_;   // at the start
  IdentificationWorker worker_;
  Reconfiguration reconfiguration_;
  SavedExperiments saved_;
  ExperimentRecorder recorder_;
  ServiceThread identify_thread_, query_thread_;
  NodeDiagnostics diagnostics_;
  ActionThread<messages::IdentifyBagsAction> identify_bags_;
  std::vector<ros::ServiceServer> services_;
};

}  // namespace uncertainty_identification
