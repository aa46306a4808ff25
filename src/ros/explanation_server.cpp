#include "ros/explanation_server.h"

#include <utility>

#include "ros/explain_request.h"

namespace uncertainty_identification {
namespace {

std::string namesOf(const std::vector<Cause>& causes) {
  std::string names;
  for (const Cause& cause : causes) {
    names += (names.empty() ? "" : ", ") + cause.name;
    for (const auto& other : cause.equivalent) names += " or " + other;
  }
  return names;
}

}  // namespace

void diagnoseExplanation(const Explanation* explanation,
                         diagnostic_updater::DiagnosticStatusWrapper& status) {
  using Level = diagnostic_msgs::DiagnosticStatus;
  if (explanation == nullptr) {
    status.summary(Level::OK, "nothing has been explained yet");
    return;
  }
  const std::string names = namesOf(explanation->causes);
  status.summary(explanation->verdict == Verdict::none ? Level::OK : Level::WARN,
                 names.empty() ? explanation->message : names + ": " + explanation->message);
  status.add("verdict", nameOf(explanation->verdict));
  for (const Cause& cause : explanation->causes) {
    status.add(cause.name, cause.advice.empty() ? cause.description : cause.advice);
  }
  status.addf("seconds [s]", "%.3g", explanation->seconds);
}

ExplanationServer::ExplanationServer(const ros::NodeHandle& private_node, Source source)
    : source_(std::move(source)),
      publisher_(
          ros::NodeHandle(private_node).advertise<messages::Explanation>("explanation", 1, true)),
      service_thread_(private_node),
      action_(std::make_unique<ActionThread<messages::ExplainExperimentsAction>>(
          private_node, "explain_experiments",
          [this](const Goal& goal, const ProgressCallback& go_on) {
            return explain(goal, go_on);
          })),
      thread_([this] { run(); }) {
  using messages::Explain;
  const boost::function<bool(Explain::Request&, Explain::Response&)> answer =
      [this](Explain::Request& request, Explain::Response& response) {
        Goal goal;
        goal.configuration = request.configuration;
        Response result = explain(goal, [](const Progress&) { return true; });
        response.code = result.code;
        response.message = std::move(result.message);
        response.explanation = std::move(result.explanation);
        return true;
      };
  service_ = service_thread_.node().advertiseService("explain", answer);
}

void ExplanationServer::start() {
  service_thread_.start();
  action_->start();
}

void ExplanationServer::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_one();
  service_.shutdown();
  service_thread_.stop();
  action_.reset();
  if (thread_.joinable()) thread_.join();
}

void ExplanationServer::experimentAdded() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++unexplained_;
}

void ExplanationServer::resultPublished() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++results_;
  }
  changed_.notify_one();
}

void ExplanationServer::reset() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++resets_;
  unexplained_ = 0;
  last_.reset();
}

std::shared_ptr<const Explanation> ExplanationServer::last() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return last_;
}

ExplanationServer::Response ExplanationServer::explain(const Goal& goal,
                                                       const ProgressCallback& progress) {
  const unsigned resets = resets_;
  const bool own = goal.bags.empty();
  const auto running =
      source_.begins(own ? "explaining the node's experiments"
                         : "explaining " + std::to_string(goal.bags.size()) + " bags of a request");
  ExplainAnswer answer =
      answerExplain(goal, source_.configuration(), source_.experiments, source_.sequence(),
                    [&](const Progress& at) {
                      return progress(at) && !stopping_ && ros::ok() && !(own && resets != resets_);
                    });
  if (own && answer.explanation) publish(answer.result, std::move(*answer.explanation), resets);
  return std::move(answer.result);
}

void ExplanationServer::publish(const Response& response, Explanation explanation,
                                unsigned resets) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (resets != resets_) return;
  ROS_INFO_STREAM("explanation of the node's experiments: " << explanation.message);
  last_ = std::make_shared<const Explanation>(std::move(explanation));
  publisher_.publish(response.explanation);
  source_.explained(*last_);
}

/// Waits until there are other results than `*results` counts, and updates it. Returns false when
/// the server stops.
bool ExplanationServer::waitForResult(std::uint64_t* results) {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait(lock, [&] { return stopping_ || results_ != *results; });
  *results = results_;
  return !stopping_;
}

bool ExplanationServer::isDue(int after_experiments) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (after_experiments == 0 || unexplained_ < after_experiments) return false;
  unexplained_ = 0;
  return true;
}

/// The thread of the automatic explanations.
void ExplanationServer::run() {
  for (std::uint64_t results = 0; waitForResult(&results);) {
    if (!isDue(source_.configuration().explanation.after_experiments)) continue;
    const Response answer = explain({}, [](const Progress&) { return true; });
    if (answer.code != Response::OK && answer.code != Response::CANCELLED)
      ROS_WARN_STREAM("the experiments could not be explained: " << answer.message);
  }
}

}  // namespace uncertainty_identification
