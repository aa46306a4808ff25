#pragma once

#include <ros/ros.h>

#include <mutex>
#include <string>

#include "ros/messages.h"
#include "support/wait_for.h"

namespace uncertainty_identification {

/// A client of the node /identification. Its callbacks run in a thread of its own.
class NodeClient {
 public:
  NodeClient() : spinner_(1) {
    status_subscriber_ = node_.subscribe<messages::IdentificationStatus>(
        "status", 100, [this](const messages::IdentificationStatus::ConstPtr& status) {
          const std::lock_guard<std::mutex> lock(mutex_);
          status_ = *status;
          heard_ = true;
        });
    spinner_.start();
  }

  ros::NodeHandle& node() { return node_; }

  messages::IdentificationStatus status() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return status_;
  }

  /// All that the status tells in words, one finding in each line.
  std::string told() const {
    const messages::IdentificationStatus now = status();
    std::string all = now.message + "\n" + now.store_problem;
    for (const auto& problem : now.problems) all += "\n" + problem;
    return all;
  }

  /// Waits for the node to be up.
  bool waitForNode() {
    return waitFor([this] {
      const std::lock_guard<std::mutex> lock(mutex_);
      return heard_;
    });
  }

  /// Waits until so many experiments are stored and no work is left.
  bool waitUntilStored(std::uint32_t count) {
    return waitFor([&] {
      const auto now = status();
      return now.stored_count >= count && now.queue == 0 &&
             now.state != messages::IdentificationStatus::IDENTIFYING;
    });
  }

  template <typename Service>
  typename Service::Response call(const std::string& name,
                                  const typename Service::Request& request = {}) {
    Service service;
    service.request = request;
    if (!ros::service::waitForService(node_.resolveName(name), 240000) ||
        !ros::service::call(node_.resolveName(name), service))
      throw std::runtime_error("service '" + name + "' did not answer");
    return service.response;
  }

 private:
  ros::NodeHandle node_{"/identification"};
  mutable std::mutex mutex_;
  messages::IdentificationStatus status_;
  bool heard_ = false;
  ros::Subscriber status_subscriber_;
  ros::AsyncSpinner spinner_;
};

/// The latest message on a topic, heard by the spinner of a NodeClient.
template <typename Message>
class Latest {
 public:
  explicit Latest(const std::string& topic)
      : subscriber_(node_.subscribe<Message>(topic, 10, [this](const auto& message) {
          const std::lock_guard<std::mutex> lock(mutex_);
          message_ = *message;
        })) {}

  Message get() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return message_;
  }

 private:
  mutable std::mutex mutex_;
  Message message_;
  ros::NodeHandle node_;
  ros::Subscriber subscriber_;  // last: its callback finds the rest
};

/// Plays a bag to its end, on its own clock. Returns the exit status of `rosbag play`.
inline int playBag(const std::string& path, const std::string& options) {
  const std::string command = "rosbag play --quiet --clock --queue=10000 --wait-for-subscribers " +
                              options + " " + path + " < /dev/null > /dev/null";
  return std::system(command.c_str());
}

}  // namespace uncertainty_identification
