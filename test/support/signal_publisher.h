#pragma once

#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <string>

#include "ros/messages.h"
#include "support/node_client.h"
#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// Publishes input and output of the node /identification in mode service, as a rig does.
class SignalPublisher {
 public:
  explicit SignalPublisher(NodeClient& client) : client_(client) { advertise(); }

  /// Publishes both signals, once the node listens to them.
  void advertise() {
    command_ = node_.advertise<messages::Sample>("/actuator/command", 1000);
    measurement_ = node_.advertise<messages::Sample>("/sensor/measurement", 1000);
    waitFor([this] {
      return command_.getNumSubscribers() > 0 && measurement_.getNumSubscribers() > 0;
    });
  }

  void shutdown() {
    command_.shutdown();
    measurement_.shutdown();
  }

  bool trigger(const std::string& name) {
    return client_.call<std_srvs::Trigger>(name).success != 0;
  }

  /// One sample of each, stamped now.
  void publish(double u, double y) {
    messages::Sample sample;
    sample.header.stamp = ros::Time::now();
    sample.value = u;
    command_.publish(sample);
    sample.value = y;
    measurement_.publish(sample);
  }

  /// The samples first <= k < last of an experiment, when they are due.
  void publish(const Experiment& experiment, int first, int last) {
    const ros::Time begin = ros::Time::now();
    for (int k = first; k < last; ++k) {
      ros::Time::sleepUntil(begin + ros::Duration((k - first) * experiment.sample_time));
      publish(experiment.u[k], experiment.y[k]);
    }
  }

  /// Starts an experiment, publishes it and finishes it.
  bool record(const Experiment& experiment) {
    if (!trigger("start_experiment")) return false;
    publish(experiment, 0, experiment.samples());
    return trigger("finish_experiment");
  }

 private:
  NodeClient& client_;
  ros::NodeHandle node_;
  ros::Publisher command_, measurement_;
};

}  // namespace uncertainty_identification
