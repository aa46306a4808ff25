#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <mutex>
#include <string>

#include "ros/messages.h"
#include "session/node_status.h"

namespace uncertainty_identification {

/// The status as a message.
messages::IdentificationStatus toMessage(const NodeStatus& node, const RecorderStatus& recorder);

/// Publishes the latched topic ~status. All functions may be called from any thread.
class StatusPublisher {
 public:
  /// `node` is called for each status that is published, and `published` after each. Neither may
  /// call the publisher.
  StatusPublisher(ros::NodeHandle private_node, std::function<NodeStatus()> node,
                  std::function<void()> published);

  void publish();

  /// Blocks until a running publish() has ended; afterwards nothing is published any more.
  void close();

  void setRunning(bool running);
  void addProblem(const std::string& problem);
  void removeProblem(const std::string& problem);
  void forgetProblems();

  RecorderStatus recorder() const;

 private:
  void publishLocked();

  ros::Publisher publisher_;
  std::function<NodeStatus()> node_;
  std::function<void()> published_;
  bool closed_ = false;
  mutable std::mutex mutex_;  // guards closed_ and recorder_, and keeps messages in order
  RecorderStatus recorder_;
};

}  // namespace uncertainty_identification
