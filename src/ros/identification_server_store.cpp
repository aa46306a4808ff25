#include <iostream>
#include <nlohmann/json.hpp>
#include <utility>

#include "data/experiment_checks.h"
#include "io/printable.h"
#include "live/live_page.h"
#include "ros/answer.h"
#include "ros/identification_server.h"
#include "ros/keeping_requests.h"
#include "ros/simulation_error_publisher.h"
#include "uncertainty_identification/io/configuration_yaml.h"

/// What the server stores so that it survives a restart, and the services that save, load, reject
/// and reconfigure.
namespace uncertainty_identification {
namespace {

/// Logs an error when the node ends. After ros::shutdown() the logger prints nothing any more; the
/// line then goes where it prints errors.
void logAtTheEnd(const std::string& line) {
  if (ros::ok())
    ROS_ERROR_STREAM(line);
  else
    std::cerr << "[ERROR]: " << line << std::endl;
}

}  // namespace

IdentificationWorker::Listener IdentificationServer::workerListener() {
  IdentificationWorker::Listener listener;
  listener.result = [this](const WorkerResult& result) {
    const auto before = results_.lastEstimate().first;
    const ResultContext context = results_.publish(result);
    ROS_INFO_STREAM(resultLine(result, context.sequence, before.get()));
    summaries_.add(result, context);
    explanations_.resultPublished();
    if (store_) store_->keep(StoredResult{result.estimate, context, result.configuration});
  };
  listener.kept = [this](const KeptExperiment& experiment) {
    ROS_INFO_STREAM(keptLine(experiment, configuration_.limits));
    explanations_.experimentAdded();
    if (experiment.defect.empty()) simulation_errors_->add(experiment.experiment);
    if (store_) store_->keep(experiment);
  };
  listener.rejected = [this](const RejectedExperiment& rejected) {
    ROS_INFO_STREAM(rejectedLine(rejected));
    if (store_) store_->reject(rejected);
  };
  listener.changed = [this] { status_.publish(); };
  listener.warning = [this](const std::string& warning) { warn(warning); };
  listener.progress = [this](const Progress& progress) {
    if (live_) live_->changed(progress);
  };
  listener.begins = [this](const std::string& what) { return activities_.begin(what); };
  return listener;
}

StoreWriter::Listener IdentificationServer::storeListener() {
  return {[this](const StoreStatus& now) {
            if (const auto line = store_log_.line(now)) ROS_ERROR_STREAM(*line);
            status_.publish();
          },
          [](const std::vector<std::string>& files) { logAtTheEnd(unwrittenLine(files)); }};
}

/// Logs a warning as such when it is the first one of its cause.
void IdentificationServer::warn(const std::string& message) {
  if (warned_.isNew(message))
    ROS_WARN_STREAM(printableText(message));
  else
    ROS_DEBUG_STREAM(printableText(message));
}

/// Of a node with a store, the stored experiments are those on the disk.
NodeStatus IdentificationServer::nodeStatus() const {
  NodeStatus status{worker_.status(), "", activities_.running(), waitingRequests(),
                    results_.sequence()};
  if (!store_) return status;
  const StoreStatus store = store_->status();
  status.worker.stored = store.stored;
  status.worker.last_id = store.last_id;
  status.store_problem = store.message;
  return status;
}

void IdentificationServer::restore() {
  if (!store_) return;
  for (const auto& warning : stored_.warnings) ROS_WARN_STREAM(warning);
  std::optional<WorkerResult> last;
  if (stored_.result) {
    const StoredResult& stored = *stored_.result;
    const std::size_t rejected = stored_.rejected.size() + stored.estimate->rejected.size();
    const WorkerResult result{stored.estimate,       stored.context.preliminary,
                              stored.context.window, stored.configuration,
                              stored_.kept,          static_cast<int>(rejected)};
    results_.publishAgain(stored.estimate, stored.context);
    summaries_.add(result, stored.context);
    if (toJson(result.configuration) == toJson(configuration_)) last = result;
  }
  if (!stored_.kept.empty())
    ROS_INFO_STREAM("the node continues with " << stored_.kept.size()
                                               << " experiments of its store");
  for (const KeptExperiment& kept : stored_.kept)
    if (defectOf(*kept.experiment, configuration_.limits).empty())
      simulation_errors_->add(kept.experiment);
  worker_.restore(std::move(stored_.kept), std::move(stored_.rejected), stored_.last_number, last);
  stored_ = {};
}

void IdentificationServer::advertiseKeeping() {
  using messages::Configure;
  using messages::Load;
  using messages::RejectExperiment;
  using messages::Save;
  const boost::function<bool(Configure::Request&, Configure::Response&)> configure =
      [this](Configure::Request& request, Configure::Response& response) {
        const auto running = activities_.begin("answering ~configure");
        response =
            answerConfigure(request, reconfiguration_, [this] { return !stopping_ && ros::ok(); });
        response.sequence = results_.sequence();
        return true;
      };
  const boost::function<bool(RejectExperiment::Request&, RejectExperiment::Response&)> reject =
      [this](RejectExperiment::Request& request, RejectExperiment::Response& response) {
        response = rejectExperiment(request);
        return true;
      };
  const boost::function<bool(Save::Request&, Save::Response&)> save =
      [this](Save::Request& request, Save::Response& response) {
        response = answerSave(request, saved_, results_.last());
        return true;
      };
  const boost::function<bool(Load::Request&, Load::Response&)> load =
      [this](Load::Request& request, Load::Response& response) {
        response = answerLoad(request, saved_);
        return true;
      };
  services_.push_back(identify_thread_.node().advertiseService("configure", configure));
  services_.push_back(query_thread_.node().advertiseService("reject_experiment", reject));
  services_.push_back(query_thread_.node().advertiseService("save", save));
  services_.push_back(query_thread_.node().advertiseService("load", load));
}

messages::RejectExperiment::Response IdentificationServer::rejectExperiment(
    const messages::RejectExperiment::Request& request) {
  constexpr std::size_t kLongest = 1000;
  using Response = messages::RejectExperiment::Response;
  if (request.reason.size() > kLongest)
    return answerOf<Response>(Response::REFUSED,
                              "reason: found " + std::to_string(request.reason.size()) +
                                  " characters; allowed: up to " + std::to_string(kLongest));
  const std::string reason =
      request.reason.empty() ? "rejected on request" : printable(request.reason);
  const auto number = worker_.reject(printable(request.id), reason);
  if (!number)
    return answerOf<Response>(
        Response::NOT_FOUND,
        "there is no experiment '" + request.id.substr(0, kLongest) +
            "' to reject; ~list_experiments names the experiments that are identified from");
  if (store_) store_->reject(*number, {printable(request.id), reason});
  return answerOf<Response>(Response::OK,
                            "experiment '" + request.id + "' is left out from now on");
}

}  // namespace uncertainty_identification
