#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

namespace uncertainty_identification {

/// A callback queue with a thread of its own: what is advertised through node() is answered there
/// and blocks nothing else.
class ServiceThread {
 public:
  explicit ServiceThread(const ros::NodeHandle& node) : node_(node), spinner_(1, &queue_) {
    node_.setCallbackQueue(&queue_);
  }

  ros::NodeHandle& node() { return node_; }

  void start() { spinner_.start(); }

  /// Waits for the answer that is being given, if any.
  void stop() { spinner_.stop(); }

 private:
  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  ros::AsyncSpinner spinner_;
};

}  // namespace uncertainty_identification
