#include "ros/identification_server.h"

#include <utility>

#include "io/open_simulation.h"
#include "live/live_page.h"
#include "own_simulation/logged_simulation.h"
#include "ros/checked_service.h"
#include "ros/experiment_bag.h"
#include "ros/identify_request.h"
#include "ros/message_conversions.h"
#include "ros/simulation_error_publisher.h"
#include "session/mebibytes.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

std_srvs::Trigger::Response answer(bool success, const std::string& message) {
  std_srvs::Trigger::Response response;
  response.success = success;
  response.message = message;
  return response;
}

std::unique_ptr<StoreWriter> openStore(const Configuration& parameters,
                                       StoreWriter::Listener listener) {
  if (parameters.store_directory.empty()) return nullptr;
  return std::make_unique<StoreWriter>(parameters.store_directory, experimentBags(),
                                       parameters.limits, std::move(listener));
}

}  // namespace

IdentificationServer::IdentificationServer(const ros::NodeHandle& node,
                                           const ros::NodeHandle& private_node,
                                           const Configuration& parameters)
    : live_(openLivePage(parameters.live_page_port)),
      status_(
          private_node, [this] { return nodeStatus(); },
          [this] {
            if (live_) live_->changed();
          }),
      activities_([] { return ros::Time::now().toSec(); }, [this] { status_.publish(); }),
      results_(private_node),
      explanations_(private_node, explanationSource()),
      reports_(parameters.report_directory),
      bounds_(private_node, beginning(),
              [this](const auto& result, const auto& context) { bounded(result, context); }),
      summaries_(private_node, beginning(),
                 [this](const auto& result, const auto& context) { summarised(result, context); }),
      store_(openStore(parameters, storeListener())),
      stored_(store_ ? store_->load() : StoredState()),
      configuration_(configurationAtStart(parameters, stored_.configuration)),
      simulation_errors_(std::make_unique<SimulationErrorPublisher>(private_node, configuration_)),
      worker_(configuration_, workerListener()),
      reconfiguration_(parameters, configuration_, worker_,
                       [this](const StoredConfiguration& configuration) {
                         if (store_) store_->keep(configuration);
                       }),
      saved_(parameters.store_directory, experimentBags(), parameters.limits, worker_),
      recorder_(node, private_node, withLoggedSimulation(configuration_),
                {[this](FinishedExperiment experiment) { worker_.add(std::move(experiment)); },
                 [this](const std::string& problem) {
                   warn(problem);
                   status_.addProblem(problem);
                 },
                 [this](bool running) { status_.setRunning(running); },
                 [this](const std::string& problem) { status_.removeProblem(problem); }}),
      identify_thread_(private_node),
      query_thread_(private_node),
      diagnostics_(node, private_node,
                   {[this] { return recorder_.activity(); }, [this] { return recorder_.running(); },
                    [this] { return worker_.status(); }}),
      identify_bags_(private_node, "identify_bags",
                     [this](const messages::IdentifyBagsGoal& goal, const ProgressCallback& go_on) {
                       const auto running = activities_.begin("identifying from " +
                                                              std::to_string(goal.bags.size()) +
                                                              " bags (~identify_bags)");
                       return answerIdentifyBags(goal, reconfiguration_.current(), go_on);
                     }) {
  start(private_node);
}

std::unique_ptr<LivePage> IdentificationServer::openLivePage(int port) {
  if (port == 0) return nullptr;
  auto page = std::make_unique<LivePage>(
      port, LivePage::Source{
                [this] {
                  return LiveStatus{nodeStatus(), status_.recorder(), ros::Time::now().toSec()};
                },
                [this] { return worker_.experiments(); }});
  ROS_INFO_STREAM("the live page is http://127.0.0.1:" << port << "/");
  return page;
}

ExplanationServer::Source IdentificationServer::explanationSource() {
  return {[this] { return reconfiguration_.current(); }, [this] { return machineExperiments(); },
          [this] { return results_.sequence(); }, beginning(),
          [this](const Explanation& explanation) {
            if (live_) live_->show(explanation);
          }};
}

/// The experiments without the user's simulation, which is no covariate of the machine.
std::vector<Experiment> IdentificationServer::machineExperiments() const {
  std::vector<Experiment> experiments = worker_.snapshot().experiments;
  if (!configuration_.simulation) return experiments;
  return withoutSignal(std::move(experiments), loggedName(*configuration_.simulation));
}

/// Serves what was restored from the store, and from now on requests.
void IdentificationServer::start(const ros::NodeHandle& private_node) {
  addDiagnostics();
  restore();
  advertiseTriggers(private_node);
  advertiseRequests();
  advertiseKeeping();
  identify_thread_.start();
  query_thread_.start();
  identify_bags_.start();
  explanations_.start();
  if (live_) live_->start();
  constexpr double kPeriod = 0.25;  // [s] within which a change is published
  waiting_timer_ = ros::NodeHandle(private_node)
                       .createWallTimer(ros::WallDuration(kPeriod), [this](const auto&) {
                         if (waitingRequests() != waiting_published_) status_.publish();
                         waiting_published_ = waitingRequests();
                       });
  status_.publish();
}

void IdentificationServer::addDiagnostics() {
  diagnostics_.add("explanation", [this](auto& status) {
    diagnoseExplanation(explanations_.last().get(), status);
  });
  diagnostics_.add("activity", [this](auto& status) {
    diagnoseActivity(activities_.running(), waitingRequests(), ros::Time::now().toSec(), status);
  });
  if (simulation_errors_->active())
    diagnostics_.add("simulation", [this](auto& status) {
      diagnoseSimulation(simulation_errors_->last(), status);
    });
  if (store_)
    diagnostics_.add("store", [this](auto& status) { diagnoseStore(store_->status(), status); });
}

int IdentificationServer::waitingRequests() const {
  return identify_thread_.waiting() + explanations_.waiting() + identify_bags_.waiting();
}

IdentificationServer::~IdentificationServer() {
  stopping_ = true;
  waiting_timer_.stop();
  if (live_) live_->stop();
  status_.close();
  for (auto& service : services_) service.shutdown();
  explanations_.stop();
  identify_thread_.stop();
  query_thread_.stop();
}

void IdentificationServer::advertiseTrigger(ros::NodeHandle& node, const std::string& name,
                                            const std::function<Trigger::Response()>& answer) {
  const boost::function<bool(Trigger::Request&, Trigger::Response&)> callback =
      [answer](Trigger::Request&, Trigger::Response& response) {
        response = answer();
        return true;
      };
  services_.push_back(node.advertiseService(name, callback));
}

void IdentificationServer::advertiseTriggers(ros::NodeHandle node) {
  advertiseTrigger(node, "start_experiment", [this] {
    return recorder_.start() ? answer(true, "the experiment has begun")
                             : answer(false,
                                      "an experiment runs already, or experiment.mode is "
                                      "neither topic nor service");
  });
  advertiseTrigger(node, "finish_experiment", [this] {
    return recorder_.finish() ? answer(true, "the experiment has ended")
                              : answer(false, "no experiment that was started is running");
  });
  advertiseTrigger(node, "discard_experiment", [this] {
    return recorder_.discard() ? answer(true, "the experiment was dropped")
                               : answer(false, "no experiment that was started is running");
  });
  advertiseTrigger(node, "reset", [this] { return reset(); });
}

std_srvs::Trigger::Response IdentificationServer::reset() {
  status_.forgetProblems();
  warned_.forget();
  recorder_.reset();
  worker_.reset();
  simulation_errors_->reset();
  if (store_) store_->reset();
  const std::uint32_t last = results_.forget();
  explanations_.reset();
  if (live_) live_->forget(last);
  status_.publish();
  return answer(true, "all experiments and the result were dropped");
}

void IdentificationServer::advertiseRequests() {
  using messages::GetResult;
  using messages::Identify;
  using messages::ListExperiments;
  using messages::SampleModels;
  using messages::WriteReport;
  const boost::function<bool(Identify::Request&, Identify::Response&)> identify =
      [this](Identify::Request& request, Identify::Response& response) {
        const auto running = activities_.begin("answering ~identify");
        response = answerIdentify(request, reconfiguration_.current(),
                                  [this](const Progress&) { return !stopping_ && ros::ok(); });
        return true;
      };
  const boost::function<bool(GetResult::Request&, GetResult::Response&)> get_result =
      [this](GetResult::Request&, GetResult::Response& response) {
        response = getResult();
        return true;
      };
  const boost::function<bool(ListExperiments::Request&, ListExperiments::Response&)> list =
      [this](ListExperiments::Request&, ListExperiments::Response& response) {
        response = listExperiments();
        return true;
      };
  const boost::function<bool(SampleModels::Request&, SampleModels::Response&)> sample =
      [this](SampleModels::Request& request, SampleModels::Response& response) {
        const auto last = results_.lastEstimate();
        response = answerSampleModels(request, last.first.get(), last.second);
        return true;
      };
  services_.push_back(advertiseChecked<Identify>(
      identify_thread_.node(), "identify", identify, Identify::Response::DATA_ERROR,
      mebibytes(configuration_.limits.max_request_size)));
  services_.push_back(query_thread_.node().advertiseService("get_result", get_result));
  services_.push_back(query_thread_.node().advertiseService("list_experiments", list));
  services_.push_back(query_thread_.node().advertiseService("sample_models", sample));
  const boost::function<bool(WriteReport::Request&, WriteReport::Response&)> report =
      [this](WriteReport::Request& request, WriteReport::Response& response) {
        response = writeReport(request);
        return true;
      };
  services_.push_back(query_thread_.node().advertiseService("write_report", report));
}

messages::GetResult::Response IdentificationServer::getResult() const {
  messages::GetResult::Response response;
  const auto last = results_.last();
  if (last) {
    response.result = *last;
    response.message = last->message;
  } else {
    response.code = messages::GetResult::Response::NONE_YET;
    response.message = "there is no result yet: " + worker_.status().message;
  }
  return response;
}

messages::ListExperiments::Response IdentificationServer::listExperiments() const {
  messages::ListExperiments::Response response;
  for (const auto& digest : worker_.experiments())
    response.experiments.push_back(toMessage(digest));
  return response;
}

messages::WriteReport::Response IdentificationServer::writeReport(
    const messages::WriteReport::Request& request) const {
  const auto [estimate, sequence] = results_.lastEstimate();
  if (estimate == nullptr) return reports_.answer(request, nullptr, nullptr);
  std::optional<Result> result = bounds_.resultOf(sequence);
  if (!result) result = summaries_.resultOf(sequence);
  if (!result) result = Result{*estimate, {}};
  return reports_.answer(request, &*result, explanations_.last().get());
}

/// What the computing parts call with what they begin; it ends with the object that they get.
std::function<Activities::Token(const std::string&)> IdentificationServer::beginning() {
  return [this](const std::string& what) { return activities_.begin(what); };
}

/// Bounds follow the summary, so that they come with it.
void IdentificationServer::summarised(const Result& result, const ResultContext& context) {
  if (live_) live_->show(result, context);
  bounds_.add(result, context);
}

void IdentificationServer::bounded(const Result& result, const ResultContext& context) {
  if (live_) live_->show(result, context);
  if (!configuration_.report_each_result) return;
  const auto answer = reports_.answer({}, &result, explanations_.last().get());
  if (answer.code != messages::WriteReport::Response::OK) warn(answer.message);
}

}  // namespace uncertainty_identification
