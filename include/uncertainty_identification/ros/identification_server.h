#pragma once

#include <ros/node_handle.h>
#include <std_srvs/Trigger.h>

#include <atomic>
#include <string>
#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/ros/action_thread.h"
#include "uncertainty_identification/ros/bounds_publisher.h"
#include "uncertainty_identification/ros/experiment_recorder.h"
#include "uncertainty_identification/ros/identification_worker.h"
#include "uncertainty_identification/ros/messages.h"
#include "uncertainty_identification/ros/node_diagnostics.h"
#include "uncertainty_identification/ros/report_writer.h"
#include "uncertainty_identification/ros/result_publisher.h"
#include "uncertainty_identification/ros/service_thread.h"
#include "uncertainty_identification/ros/status_publisher.h"

namespace uncertainty_identification {

/// The node: topics to experiments (ExperimentRecorder), experiments to results
/// (IdentificationWorker), results to topics (ResultPublisher, BoundsPublisher, StatusPublisher),
/// and services.
/// Topics and ~start_experiment, ~finish_experiment, ~discard_experiment, ~reset are served by the
/// thread that spins; ~identify by one thread, the action ~identify_bags by two, ~get_result,
/// ~list_experiments and ~sample_models by another, so that no request keeps a sample from being
/// recorded, or another from being answered.
class IdentificationServer {
 public:
  /// Throws ConfigurationError when the configuration is not valid, or asks for a store.
  IdentificationServer(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                       const Configuration& configuration);

  /// Cancels what is running.
  ~IdentificationServer();

 private:
  using Trigger = std_srvs::Trigger;

  void advertiseTriggers(ros::NodeHandle node);
  void advertiseRequests();
  void advertiseTrigger(ros::NodeHandle& node, const std::string& name,
                        const std::function<Trigger::Response()>& answer);
  Trigger::Response reset();
  messages::GetResult::Response getResult() const;
  messages::ListExperiments::Response listExperiments() const;
  messages::WriteReport::Response writeReport(const messages::WriteReport::Request& request) const;

  const Configuration configuration_;
  std::atomic<bool> stopping_{false};
  ResultPublisher results_;
  ReportWriter reports_;
  BoundsPublisher bounds_;
  StatusPublisher status_;
  IdentificationWorker worker_;
  ExperimentRecorder recorder_;
  ServiceThread identify_thread_, query_thread_;
  NodeDiagnostics diagnostics_;
  ActionThread<messages::IdentifyBagsAction> identify_bags_;
  std::vector<ros::ServiceServer> services_;
};

}  // namespace uncertainty_identification
