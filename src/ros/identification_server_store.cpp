#include <nlohmann/json.hpp>
#include <utility>

#include "ros/identification_server.h"
#include "uncertainty_identification/io/configuration_yaml.h"

/// What the server keeps over its end, and the services about it.
namespace uncertainty_identification {

IdentificationWorker::Listener IdentificationServer::workerListener() {
  IdentificationWorker::Listener listener;
  listener.result = [this](const WorkerResult& result) {
    const ResultContext context = results_.publish(result);
    bounds_.add(result.estimate, context);
    explanations_.resultCame();
    if (store_) store_->keep(StoredResult{result.estimate, context, result.configuration});
  };
  listener.kept = [this](const KeptExperiment& experiment) {
    explanations_.experimentCame();
    if (store_) store_->keep(experiment);
  };
  listener.rejected = [this](const RejectedExperiment& rejected) {
    if (store_) store_->reject(rejected);
  };
  listener.changed = [this] { status_.publish(); };
  listener.warning = [](const std::string& warning) { ROS_WARN_STREAM(warning); };
  return listener;
}

/// An experiment counts as stored once it is on the disk.
WorkerStatus IdentificationServer::workerStatus() const {
  WorkerStatus status = worker_.status();
  if (!store_) return status;
  const StoreStatus store = store_->status();
  status.stored = store.stored;
  status.last_id = store.last_id;
  status.failed = status.failed || store.failing;
  if (!store.message.empty()) status.message += "\n" + store.message;
  return status;
}

void IdentificationServer::restore() {
  if (!store_) return;
  for (const auto& warning : stored_.warnings) ROS_WARN_STREAM(warning);
  std::optional<WorkerResult> last;
  if (stored_.result) {
    const StoredResult& result = *stored_.result;
    results_.publishAgain(result.estimate, result.context);
    bounds_.add(result.estimate, result.context);
    if (toJson(result.configuration) == toJson(configuration_))
      last = WorkerResult{result.estimate, result.context.preliminary, result.context.window,
                          result.configuration};
  }
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
        response = reconfiguration_.answer(request, [this] { return !stopping_ && ros::ok(); });
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
        response = saved_.save(request, results_.last());
        return true;
      };
  const boost::function<bool(Load::Request&, Load::Response&)> load =
      [this](Load::Request& request, Load::Response& response) {
        response = saved_.load(request);
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
  messages::RejectExperiment::Response response;
  if (request.reason.size() > kLongest) {
    response.code = messages::RejectExperiment::Response::REFUSED;
    response.message = "reason: found " + std::to_string(request.reason.size()) +
                       " characters; allowed: up to " + std::to_string(kLongest);
    return response;
  }
  const std::string reason = request.reason.empty() ? "rejected on request" : request.reason;
  const auto number = worker_.reject(request.id, reason);
  if (!number) {
    response.code = messages::RejectExperiment::Response::NOT_FOUND;
    response.message = "no experiment '" + request.id.substr(0, kLongest) +
                       "' is identified from; ~list_experiments names those that are";
    return response;
  }
  if (store_) store_->reject(*number, {request.id, reason});
  response.message = "experiment '" + request.id + "' is left out from now on";
  return response;
}

}  // namespace uncertainty_identification
