#pragma once

#include <functional>
#include <string>
#include <vector>

#include "data/experiment_cutter.h"
#include "ros/signal_decoder.h"
#include "ros/topic_activity.h"
#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

/// How a topic's name in the configuration becomes a full one.
using TopicResolver = std::function<std::string(const std::string&)>;

/// Brings messages of the configured topics to the cutter: the bag reader and the live recorder
/// differ only in where messages come from. A topic may carry several signals, e.g. effort and
/// velocity of the same joint.
class TopicRouter {
 public:
  /// Throws ConfigurationError for experiment.mode message, where nothing is to be cut.
  TopicRouter(const Configuration& configuration, const TopicResolver& resolve);

  TopicRouter(const TopicRouter&) = delete;  // the routes refer to the cutter
  TopicRouter& operator=(const TopicRouter&) = delete;

  /// What a topic is read for, in words, e.g. "input.topic".
  struct Use {
    std::string topic, key;
    TopicRole role;
    long left_out;  ///< messages, so far
  };

  /// The topics to listen to; one that serves several purposes is listed for each.
  std::vector<Use> uses() const;

  /// Decodes the message for every signal of the topic. A message that is broken is left out and
  /// told by warnings(). Throws ConfigurationError when its type has no such field, or a marker is
  /// neither std_msgs/Bool nor ExperimentMarker.
  void add(const std::string& topic, const RawMessage& message);

  ExperimentCutter& cutter() { return cutter_; }
  const ExperimentCutter& cutter() const { return cutter_; }

  /// Topics whose stamps are times of receipt, in order.
  std::vector<std::string> stampedOnReceipt() const;

  /// Why messages of a topic were left out, once for each signal, since the last call.
  std::vector<std::string> takeProblems();

  /// How many messages were left out on which topic, and why the first was. One sentence each.
  std::vector<std::string> warnings() const;

 private:
  struct Count {
    std::string key, topic;
    TopicRole role;
    long left_out = 0;
    std::string reason;  // of the first
  };
  struct Route {
    SignalDecoder decoder;
    std::function<void(StampedValue)> deliver;
    Count count;
  };

  void addRoute(TopicRole role, const std::string& key, const SignalOptions& signal,
                const TopicResolver& resolve, std::function<void(StampedValue)> deliver);
  void addMarker(const RawMessage& message);
  void countLeftOut(Count& count, const std::string& reason);

  ExperimentCutter cutter_;
  std::vector<Route> routes_;
  std::string marker_topic_;  // empty: experiments are not cut by a topic
  Count marker_count_;
  std::vector<std::string> problems_;
};

}  // namespace uncertainty_identification
