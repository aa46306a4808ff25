#pragma once

#include <std_srvs/Trigger.h>

#include <atomic>

#include "ros/action_thread.h"
#include "ros/bounds_publisher.h"
#include "ros/experiment_recorder.h"
#include "ros/explanation_server.h"
#include "ros/node_diagnostics.h"
#include "ros/report_writer.h"
#include "ros/result_publisher.h"
#include "ros/service_thread.h"
#include "ros/status_publisher.h"
#include "ros/summary_publisher.h"
#include "session/log_lines.h"
#include "session/reconfiguration.h"
#include "session/saved_experiments.h"

namespace uncertainty_identification {

class LivePage;
class SimulationErrorPublisher;

/// The identification node. ExperimentRecorder makes experiments of the messages on topics,
/// IdentificationWorker makes results of the experiments, StoreWriter keeps both on the disk, and
/// ResultPublisher, SummaryPublisher, BoundsPublisher and StatusPublisher publish the results,
/// SimulationErrorPublisher how far the simulation of the user is from the experiments.
/// ExplanationServer explains them, LivePage shows them. This class connects these parts and serves
/// the services.
///
/// The thread that spins serves the topics and ~start_experiment, ~finish_experiment,
/// ~discard_experiment and ~reset. One more thread serves ~identify and ~configure, two serve the
/// action ~identify_bags, and one serves the other services. So no request delays the recording of
/// samples, and a slow request does not delay a quick one.
class IdentificationServer {
 public:
  /// Continues with the experiments and the result in the store if store_directory is configured.
  /// Throws ConfigurationError when the configuration is not valid or the store cannot be opened.
  IdentificationServer(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                       const Configuration& parameters);

  /// Cancels all running work and blocks until it has ended.
  ~IdentificationServer();

 private:
  using Trigger = std_srvs::Trigger;

  void start(const ros::NodeHandle& private_node);
  IdentificationWorker::Listener workerListener();
  NodeStatus nodeStatus() const;
  std::unique_ptr<LivePage> openLivePage(int port);
  ExplanationServer::Source explanationSource();
  std::vector<Experiment> machineExperiments() const;
  std::function<Activities::Token(const std::string&)> beginning();
  void summarised(const Result& result, const ResultContext& context);
  void bounded(const Result& result, const ResultContext& context);
  int waitingRequests() const;
  void warn(const std::string& message);
  StoreWriter::Listener storeListener();
  void addDiagnostics();
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
  OncePerCause warned_;
  StoreLog store_log_;  // used in the store's thread only
  // Before all that tell them something from threads of their own:
  std::unique_ptr<LivePage> live_;  // null if live_page.port is 0
  StatusPublisher status_;
  Activities activities_;
  ResultPublisher results_;
  ExplanationServer explanations_;
  ReportWriter reports_;
  BoundsPublisher bounds_;
  SummaryPublisher summaries_;          // gives results to bounds_
  std::unique_ptr<StoreWriter> store_;  // null if store_directory is not configured
  StoredState stored_;                  // what the store held; empty after restore()
  const Configuration configuration_;   // with which the node started
  const std::unique_ptr<SimulationErrorPublisher> simulation_errors_;  // used by the worker
  IdentificationWorker worker_;
  Reconfiguration reconfiguration_;
  SavedExperiments saved_;
  ExperimentRecorder recorder_;
  ServiceThread identify_thread_, query_thread_;
  NodeDiagnostics diagnostics_;
  ActionThread<messages::IdentifyBagsAction> identify_bags_;
  std::vector<ros::ServiceServer> services_;
  int waiting_published_ = 0;  // number of waiting requests in the last status
  ros::WallTimer waiting_timer_;
};

}  // namespace uncertainty_identification
