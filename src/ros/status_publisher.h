#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "ros/messages.h"
#include "session/identification_worker.h"

namespace uncertainty_identification {

/// What the status contains in addition to the state of the worker.
struct RecorderStatus {
  bool running = false;               ///< whether an experiment is being recorded
  std::vector<std::string> problems;  ///< messages for the user about the topics
};

/// The status as a message. Of the states that apply, it has the first of: identifying, collecting,
/// error, idle.
messages::IdentificationStatus toMessage(const WorkerStatus& worker,
                                         const RecorderStatus& recorder);

/// Publishes the latched topic ~status. All functions may be called from any thread.
class StatusPublisher {
 public:
  /// `worker` returns the present state of the worker, `sequence` the number of the last result.
  /// Both are called for each status that is published.
  StatusPublisher(ros::NodeHandle private_node, std::function<WorkerStatus()> worker,
                  std::function<std::uint32_t()> sequence);

  void publish();

  /// Blocks until a running publish() has ended; afterwards nothing is published any more.
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
  std::mutex mutex_;  // guards closed_ and recorder_, and keeps messages in order
  RecorderStatus recorder_;
};

}  // namespace uncertainty_identification
