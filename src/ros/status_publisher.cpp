#include "ros/status_publisher.h"

#include <algorithm>
#include <utility>

#include "io/printable.h"
#include "ros/message_conversions.h"

namespace uncertainty_identification {
namespace {

constexpr std::size_t kMaxProblems = 5;  // in one status

std::uint8_t toMessage(NodeState state) {
  using Status = messages::IdentificationStatus;
  switch (state) {
    case NodeState::identifying:
      return Status::IDENTIFYING;
    case NodeState::collecting:
      return Status::COLLECTING;
    case NodeState::error:
      return Status::ERROR;
    case NodeState::idle:
      break;
  }
  return Status::IDLE;
}

}  // namespace

messages::IdentificationStatus toMessage(const NodeStatus& node, const RecorderStatus& recorder) {
  const WorkerStatus& worker = node.worker;
  messages::IdentificationStatus message;
  message.state = toMessage(stateOf(node, recorder));
  message.termination = toMessage(worker.termination);
  message.message = printableText(worker.message);
  message.store_problem = node.store_problem;
  for (const auto& problem : recorder.problems) message.problems.push_back(printableText(problem));
  for (const Activity& activity : node.running) {
    message.running.push_back(activity.what);
    message.running_since.push_back(ros::Time(activity.since));
  }
  message.waiting_requests = static_cast<std::uint32_t>(node.waiting_requests);
  message.stored_count = static_cast<std::uint32_t>(worker.stored);
  message.last_stored_id = worker.last_id;
  message.queue = static_cast<std::uint32_t>(worker.queue);
  message.seconds = worker.seconds;
  message.sequence = node.sequence;
  return message;
}

StatusPublisher::StatusPublisher(ros::NodeHandle private_node, std::function<NodeStatus()> node,
                                 std::function<void()> published)
    : publisher_(private_node.advertise<messages::IdentificationStatus>("status", 10, true)),
      node_(std::move(node)),
      published_(std::move(published)) {}

void StatusPublisher::publish() {
  const std::lock_guard<std::mutex> lock(mutex_);
  publishLocked();
}

void StatusPublisher::close() {
  const std::lock_guard<std::mutex> lock(mutex_);
  closed_ = true;
}

void StatusPublisher::setRunning(bool running) {
  const std::lock_guard<std::mutex> lock(mutex_);
  recorder_.running = running;
  publishLocked();
}

void StatusPublisher::addProblem(const std::string& problem) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (recorder_.problems.size() < kMaxProblems) recorder_.problems.push_back(problem);
  publishLocked();
}

void StatusPublisher::removeProblem(const std::string& problem) {
  const std::lock_guard<std::mutex> lock(mutex_);
  auto& problems = recorder_.problems;
  problems.erase(std::remove(problems.begin(), problems.end(), problem), problems.end());
  publishLocked();
}

void StatusPublisher::forgetProblems() {
  const std::lock_guard<std::mutex> lock(mutex_);
  recorder_.problems.clear();
}

RecorderStatus StatusPublisher::recorder() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return recorder_;
}

void StatusPublisher::publishLocked() {
  if (closed_) return;
  auto message = toMessage(node_(), recorder_);
  message.header.stamp = ros::Time::now();
  publisher_.publish(message);
  published_();
}

}  // namespace uncertainty_identification
