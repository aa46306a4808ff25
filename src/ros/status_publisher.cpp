#include "ros/status_publisher.h"

#include <utility>

#include "ros/message_conversions.h"

namespace uncertainty_identification {
namespace {

constexpr std::size_t kMaxProblems = 5;  // in one status

std::uint8_t stateOf(const WorkerStatus& worker, const RecorderStatus& recorder) {
  using Status = messages::IdentificationStatus;
  if (worker.busy) return Status::IDENTIFYING;
  if (recorder.running) return Status::COLLECTING;
  return worker.failed ? Status::ERROR : Status::IDLE;
}

}  // namespace

messages::IdentificationStatus toMessage(const WorkerStatus& worker,
                                         const RecorderStatus& recorder) {
  messages::IdentificationStatus message;
  message.state = stateOf(worker, recorder);
  message.termination = toMessage(worker.termination);
  message.message = worker.message;
  for (const auto& problem : recorder.problems) message.message += "\n" + problem;
  message.stored_count = static_cast<std::uint32_t>(worker.stored);
  message.last_stored_id = worker.last_id;
  message.queue = static_cast<std::uint32_t>(worker.queue);
  message.seconds = worker.seconds;
  return message;
}

StatusPublisher::StatusPublisher(ros::NodeHandle node, std::function<WorkerStatus()> worker,
                                 std::function<std::uint32_t()> sequence)
    : publisher_(node.advertise<messages::IdentificationStatus>("status", 10, true)),
      worker_(std::move(worker)),
      sequence_(std::move(sequence)) {}

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

void StatusPublisher::forgetProblems() {
  const std::lock_guard<std::mutex> lock(mutex_);
  recorder_.problems.clear();
}

void StatusPublisher::publishLocked() {
  if (closed_) return;
  auto message = toMessage(worker_(), recorder_);
  message.header.stamp = ros::Time::now();
  message.sequence = sequence_();
  publisher_.publish(message);
}

}  // namespace uncertainty_identification
