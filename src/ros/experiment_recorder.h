#pragma once

#include <ros/node_handle.h>
#include <ros/wall_timer.h>
#include <topic_tools/shape_shifter.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "ros/topic_router.h"
#include "session/recorder_policy.h"
#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

/// Listens to the configured topics, whatever their message types, and cuts what arrives into
/// experiments. All functions and callbacks run in the thread that spins, and only record. A
/// message that cannot be used is left out and reported; it never stops the node.
class ExperimentRecorder {
 public:
  using Listener = RecorderPolicy::Listener;
  using Patience = RecorderPolicy::Patience;

  /// Relative topic names resolve in the namespace of `node`; in experiment.mode message the
  /// default topic is ~experiment. Throws ConfigurationError where requireTopics() does.
  ExperimentRecorder(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                     const Configuration& configuration, Listener listener,
                     Patience patience = Patience::until_silence);

  /// Begins, ends or drops an experiment at the present time, in the modes topic and service. The
  /// result is false when that is not possible: start() needs that no experiment is running,
  /// finish() and discard() need one.
  bool start();
  bool finish();
  bool discard();

  /// Whether an experiment is being recorded.
  bool running() const { return policy_.running(); }

  /// What has arrived on the topics: one entry for each purpose that a topic is read for. Rates are
  /// those since the last call.
  std::vector<TopicActivity> activity();

  /// Forgets everything recorded so far, as when the node starts.
  void reset();

 private:
  using Event = ros::MessageEvent<const topic_tools::ShapeShifter>;
  using Clock = RecorderPolicy::Clock;

  struct Topic {
    ros::Subscriber subscriber;
    ArrivalCounter arrivals;
    bool had_publisher = false;  // since it was subscribed to
    std::string refused;         // why its last message was of a wrong type; empty: it was not
  };

  void subscribe(const std::string& topic);
  void receive(const std::string& topic, const Event& event);
  void record(const std::string& topic, const RawMessage& message);
  void passOn();
  void renewSubscriptions();
  void reportStamps();

  ros::NodeHandle node_;
  Configuration configuration_;
  RecorderPolicy policy_;
  std::unique_ptr<TopicRouter> router_;  // null in experiment.mode message
  std::map<std::string, Topic> topics_;
  ros::WallTimer timer_;
  std::vector<std::uint8_t> buffer_;  // of the message being read
};

}  // namespace uncertainty_identification
