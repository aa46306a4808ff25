#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "ros/identification_worker.h"
#include "ros/messages.h"

namespace uncertainty_identification {

/// What the status says beside what the worker tells.
struct RecorderStatus {
  bool running = false;               ///< an experiment is being recorded
  std::vector<std::string> problems;  ///< what was found about the topics
};

/// The status in one message. Its state is the first of: identifying, collecting, error, idle.
messages::IdentificationStatus toMessage(const WorkerStatus& worker,
                                         const RecorderStatus& recorder);

/// Publishes ~status, latched, whenever something changed. May be used from any thread.
class StatusPublisher {
 public:
  /// `worker` and `sequence` give the present state when a status is put together.
  StatusPublisher(ros::NodeHandle private_node, std::function<WorkerStatus()> worker,
                  std::function<std::uint32_t()> sequence);

  void publish();

  /// Publishes nothing more, and waits for what is being published.
  void close();

  void setRunning(bool running);
  void addProblem(const std::string& problem);
  void forgetProblems();

 private:
  void publishLocked();

  ros::Publisher publisher_;
  std::function<WorkerStatus()> worker_;
  std::function<std::uint32_t()> sequence_;
  bool closed_ = false;
  std::mutex mutex_;  // guards closed_ and recorder_, and the order of what is published
  RecorderStatus recorder_;
};

}  // namespace uncertainty_identification
