#pragma once

#include <ros/node_handle.h>
#include <ros/spinner.h>

#include "ros/counted_queue.h"

namespace uncertainty_identification {

/// A callback queue with a thread of its own. Services that are advertised through node() are
/// answered in this thread, so a slow answer delays no other callbacks.
class ServiceThread {
 public:
  explicit ServiceThread(const ros::NodeHandle& node) : node_(node), spinner_(1, &queue_) {
    node_.setCallbackQueue(&queue_);
  }

  ros::NodeHandle& node() { return node_; }

  void start() { spinner_.start(); }

  /// Number of requests that wait until the thread has answered another one.
  int waiting() const { return queue_.waiting(); }

  /// Blocks until a running callback has ended.
  void stop() { spinner_.stop(); }

 private:
  CountedQueue queue_;
  ros::NodeHandle node_;
  ros::AsyncSpinner spinner_;
};

}  // namespace uncertainty_identification
