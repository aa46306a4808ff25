#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "ros/messages.h"
#include "session/activities.h"
#include "session/identification_worker.h"

namespace uncertainty_identification {

/// What the status contains in addition to the state of the worker.
struct RecorderStatus {
  bool running = false;               ///< whether an experiment is being recorded
  std::vector<std::string> problems;  ///< messages for the user about the topics
};

/// What the node's other parts tell for the status.
struct NodeStatus {
  WorkerStatus worker;
  std::string store_problem;      ///< why the store cannot be written; empty: nothing is wrong
  std::vector<Activity> running;  ///< what is computed now, by the ROS clock
  int waiting_requests = 0;       ///< requests and goals that wait until another one has ended
  std::uint32_t sequence = 0;     ///< number of the last result
};

/// The status as a message. Of the states that apply, it has the first of: identifying, collecting,
/// error, idle.
messages::IdentificationStatus toMessage(const NodeStatus& node, const RecorderStatus& recorder);

/// Publishes the latched topic ~status. All functions may be called from any thread.
class StatusPublisher {
 public:
  /// `node` is called for each status that is published.
  StatusPublisher(ros::NodeHandle private_node, std::function<NodeStatus()> node);

  void publish();

  /// Blocks until a running publish() has ended; afterwards nothing is published any more.
  void close();

  void setRunning(bool running);
  void addProblem(const std::string& problem);
  void removeProblem(const std::string& problem);
  void forgetProblems();

 private:
  void publishLocked();

  ros::Publisher publisher_;
  std::function<NodeStatus()> node_;
  bool closed_ = false;
  std::mutex mutex_;  // guards closed_ and recorder_, and keeps messages in order
  RecorderStatus recorder_;
};

}  // namespace uncertainty_identification
