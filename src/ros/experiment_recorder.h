#pragma once

#include <ros/node_handle.h>
#include <ros/wall_timer.h>
#include <topic_tools/shape_shifter.h>

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "ros/identification_worker.h"
#include "ros/topic_router.h"
#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

/// Listens to the configured topics, whatever their types, and cuts what arrives into experiments.
/// All its functions and callbacks run in the thread that spins; they only record. Nothing that
/// arrives stops the node: what cannot be used is left out and reported.
class ExperimentRecorder {
 public:
  struct Listener {
    std::function<void(FinishedExperiment)> finished;
    std::function<void(const std::string&)> problem;  ///< what a user should hear; each text once
    std::function<void(bool)> running;  ///< whether an experiment runs, when that changes
  };

  /// What an experiment waits for after its end.
  enum class Patience {
    until_silence,  ///< both signals, unless all topics are silent for a second
    a_second  ///< both signals, but no longer: a command that changes rarely is not waited for
  };

  /// Relative topics resolve in the namespace of `node`, in mode message the default topic is
  /// ~experiment. Throws ConfigurationError when a topic's name is not valid.
  ExperimentRecorder(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                     const Configuration& configuration, Listener listener,
                     Patience patience = Patience::until_silence);

  /// Modes topic and service, at the present time. False if that cannot be done: one runs already,
  /// or none.
  bool start();
  bool finish();
  bool discard();

  /// Whether an experiment is being recorded.
  bool running() const { return running_; }

  /// What has arrived on the topics, one entry for each purpose; rates are since the last call.
  std::vector<TopicActivity> activity();

  /// Forgets everything recorded so far, as after a start of the node.
  void reset();

 private:
  using Event = ros::MessageEvent<const topic_tools::ShapeShifter>;

  struct Topic {
    ros::Subscriber subscriber;
    ArrivalCounter arrivals;
    bool connected = false;  // was, since it was subscribed to
  };

  void subscribe(const std::string& topic);
  void receive(const std::string& topic, const Event& event);
  void record(const std::string& topic, const RawMessage& message);
  void releaseAfterSilence();
  void renewSubscriptions();
  void handOn();
  void report(const std::string& problem);
  void reportStamps();

  ros::NodeHandle node_;
  Configuration configuration_;
  Listener listener_;
  Patience patience_;
  std::unique_ptr<TopicRouter> router_;  // none in mode message
  std::map<std::string, Topic> topics_;
  ros::WallTimer timer_;
  std::chrono::steady_clock::time_point last_arrival_;
  std::chrono::steady_clock::time_point last_release_;  // or when nothing waited last
  std::vector<std::uint8_t> buffer_;
  std::set<std::string> reported_;
  bool running_ = false;
};

}  // namespace uncertainty_identification
