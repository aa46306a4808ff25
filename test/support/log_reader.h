#pragma once

#include <ros/node_handle.h>
#include <rosgraph_msgs/Log.h>

#include <algorithm>
#include <mutex>
#include <string>
#include <vector>

namespace uncertainty_identification {

/// Hears what the node /identification logs, by the spinner of a NodeClient.
class LogReader {
 public:
  LogReader()
      : subscriber_(node_.subscribe<rosgraph_msgs::Log>(
            "/rosout", 1000, [this](const rosgraph_msgs::Log::ConstPtr& line) {
              const std::lock_guard<std::mutex> lock(mutex_);
              if (line->name == "/identification") lines_.push_back(*line);
            })) {}

  /// Number of lines of this level that contain `text`.
  long count(std::int8_t level, const std::string& text) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::count_if(lines_.begin(), lines_.end(), [&](const rosgraph_msgs::Log& line) {
      return line.level == level && line.msg.find(text) != std::string::npos;
    });
  }

 private:
  ros::NodeHandle node_;
  mutable std::mutex mutex_;  // guards lines_
  std::vector<rosgraph_msgs::Log> lines_;
  ros::Subscriber subscriber_;
};

}  // namespace uncertainty_identification
