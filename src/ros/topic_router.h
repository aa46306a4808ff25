#pragma once

#include <functional>
#include <string>
#include <vector>

#include "data/experiment_cutter.h"
#include "ros/signal_decoder.h"
#include "session/topic_activity.h"
#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

/// Converts the name of a topic in the configuration to the full name.
using TopicResolver = std::function<std::string(const std::string&)>;

/// Decodes the messages of the configured topics and passes their values to the cutter. The bag
/// reader and the live recorder both use it and differ only in the origin of the messages. A topic
/// can carry several signals, for example effort and velocity of the same joint.
class TopicRouter {
 public:
  /// Throws ConfigurationError for experiment.mode message, in which nothing is cut.
  TopicRouter(const Configuration& configuration, const TopicResolver& resolve);

  TopicRouter(const TopicRouter&) = delete;  // the routes refer to the cutter
  TopicRouter& operator=(const TopicRouter&) = delete;

  /// One purpose of a topic; `key` names it for users, e.g. "input".
  struct Use {
    std::string topic, key;
    TopicRole role;
    long left_out;    ///< number of messages left out so far
    long not_finite;  ///< number of samples so far that were NaN or infinite
  };

  /// The topics to listen to. A topic with several purposes has one entry for each.
  std::vector<Use> uses() const;

  /// Decodes the message for every signal of the topic. A broken message is left out and counted in
  /// warnings(). Throws ConfigurationError when the type has no such field, or when a marker is
  /// neither a std_msgs/Bool nor an ExperimentMarker.
  void add(const std::string& topic, const RawMessage& message);

  ExperimentCutter& cutter() { return cutter_; }
  const ExperimentCutter& cutter() const { return cutter_; }

  /// Topics whose samples are stamped with the time of receipt.
  std::vector<std::string> stampedOnReceipt() const;

  /// Returns why messages were left out since the last call, and which signals have had samples
  /// that are not finite. Each signal is reported only once.
  std::vector<std::string> takeProblems();

  /// One sentence for each signal with messages that were left out (how many, and why the first
  /// one), and one for each with samples that are NaN or infinite.
  std::vector<std::string> warnings() const;

 private:
  struct Count {
    std::string key, topic;
    TopicRole role;
    long left_out = 0;
    long not_finite = 0;
    long received = 0;     // samples, whatever their value
    std::string reason{};  // why the first one was left out
  };
  struct Route {
    SignalDecoder decoder;
    SignalOptions signal;
    std::function<void(StampedValue)> deliver;
    Count count;
  };

  void addRoute(TopicRole role, const std::string& key, const SignalOptions& signal,
                const TopicResolver& resolve, std::function<void(StampedValue)> deliver);
  void addMarker(const RawMessage& message);
  void countNotFinite(Count& count, double value);
  void countLeftOut(Count& count, const std::string& reason);

  ExperimentCutter cutter_;
  std::vector<Route> routes_;
  std::string marker_topic_;  // empty if experiments are not cut by a topic
  Count marker_count_;
  std::vector<std::string> problems_;
};

}  // namespace uncertainty_identification
