#include "uncertainty_identification/ros/bag_reader.h"

#include <std_msgs/UInt32.h>

#include <optional>
#include <set>

#include "io/checksum.h"
#include "ros/bag_file.h"
#include "ros/deserialise.h"
#include "ros/experiment_bag.h"
#include "ros/message_conversions.h"
#include "ros/topic_router.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

std::string inRootNamespace(const std::string& topic) {
  return topic.empty() || topic.front() == '/' ? topic : "/" + topic;
}

bool has(const BagFile& bag, const std::string& topic) {
  for (const auto& [id, connection] : bag.connections())
    if (connection.topic == topic) return true;
  return false;
}

void requireTopic(const BagFile& bag, const std::string& topic, const std::string& key) {
  if (has(bag, topic)) return;
  std::string message = "bag '" + bag.path() + "' has no topic '" + topic + "' (" + key + ")";
  if (key == "experiment.topic")
    message += "; name the topic that marks experiments, or cut by experiment.mode duration or gap";
  std::set<std::string> topics;
  for (const auto& [id, connection] : bag.connections())
    topics.insert(connection.topic + " [" + connection.type + "]");
  message += topics.empty() ? "; the bag is empty" : "; it holds ";
  for (const auto& each : topics) message += (each == *topics.begin() ? "" : ", ") + each;
  throw ConfigurationError(message);
}

/// Topics whose messages are complete experiments.
std::set<std::string> experimentTopics(const BagFile& bag) {
  std::set<std::string> topics;
  for (const auto& [id, connection] : bag.connections())
    if (connection.type == ros::message_traits::datatype<messages::Experiment>())
      topics.insert(connection.topic);
  return topics;
}

void throwIfCancelled(const KeepGoing& keep_going) {
  if (keep_going && !keep_going()) throw CancelledError("reading was cancelled");
}

template <typename Receive>
void readTopics(BagFile& bag, const std::set<std::string>& topics, const KeepGoing& keep_going,
                const Receive& receive) {
  bag.read(
      [&](const BagConnection& connection) {
        throwIfCancelled(keep_going);
        return topics.count(connection.topic) > 0;
      },
      [&](const BagMessage& message) {
        throwIfCancelled(keep_going);
        const BagConnection& from = message.connection;
        receive(from.topic, RawMessage{from.type, from.md5sum, from.definition, message.bytes,
                                       message.time, from.publisher});
      });
}

LoadedData readSignals(BagFile& bag, const Configuration& configuration,
                       const KeepGoing& keep_going) {
  TopicRouter router(configuration, inRootNamespace);
  std::set<std::string> topics;
  for (const auto& use : router.uses()) {
    requireTopic(bag, use.topic, use.key);
    topics.insert(use.topic);
  }
  readTopics(bag, topics, keep_going, [&](const std::string& topic, const RawMessage& message) {
    router.add(topic, message);
  });
  router.cutter().flush();

  LoadedData data;
  data.warnings = router.warnings();
  for (const auto& recording : router.cutter().takeFinished()) {
    throwIfCancelled(keep_going);
    addResampled(recording, configuration.sample_time, configuration.resampling, data);
  }
  for (auto& rejected : router.cutter().takeRejected()) data.rejected.push_back(rejected);
  return data;
}

/// Compares the messages of a bag with the checksum that writeExperimentBag() put behind them.
class ChecksumComparison {
 public:
  explicit ChecksumComparison(const BagFile& bag) : bag_(bag), has_one_(has(bag, kChecksumTopic)) {}

  /// The topics that have to be read: those that are wanted, or all where there is a checksum.
  std::set<std::string> topics(const std::set<std::string>& wanted) const {
    std::set<std::string> all = wanted;
    if (!has_one_) return all;
    for (const auto& [id, connection] : bag_.connections()) all.insert(connection.topic);
    return all;
  }

  void add(const std::string& topic, const RawMessage& message) {
    if (!has_one_) return;
    if (topic == kChecksumTopic)
      stated_ = deserialise<std_msgs::UInt32>(message).data;
    else
      sum_ += checksumOf(message.bytes.data, message.bytes.size);
  }

  /// Throws FileError.
  void requireMatch() const {
    if (has_one_ && stated_ != sum_)
      throw FileError("bag '" + bag_.path() +
                      "' does not match its checksum: it was changed after it was written; use a "
                      "copy or, if you changed it yourself, leave out the topic " +
                      kChecksumTopic + " (rosbag filter)");
  }

 private:
  const BagFile& bag_;
  const bool has_one_;
  std::uint32_t sum_ = 0;
  std::optional<std::uint32_t> stated_;
};

LoadedData readExperiments(BagFile& bag, const std::set<std::string>& topics,
                           const KeepGoing& keep_going) {
  LoadedData data;
  ChecksumComparison checksum(bag);
  const auto receive = [&](const std::string& topic, const RawMessage& message) {
    checksum.add(topic, message);
    if (topics.count(topic) == 0) return;
    try {
      data.experiments.push_back(fromMessage(deserialise<messages::Experiment>(message)));
    } catch (const DataError& error) {
      data.rejected.push_back({"a message on " + topic, error.what()});
    }
  };
  readTopics(bag, checksum.topics(topics), keep_going, receive);
  checksum.requireMatch();
  return data;
}

LoadedData readFrom(BagFile& bag, const Configuration& configuration, const KeepGoing& keep_going) {
  const auto& experiment = configuration.experiment;
  const auto complete = experimentTopics(bag);
  if (experiment.mode == ExperimentMode::message) {
    const std::string topic = inRootNamespace(experiment.topic);
    // The bags of a node's store have a topic of their own, whatever the node listens to.
    if (!has(bag, topic) && !complete.empty()) return readExperiments(bag, complete, keep_going);
    requireTopic(bag, topic, "experiment.topic");
    return readExperiments(bag, {topic}, keep_going);
  }
  if (!complete.empty() && !has(bag, inRootNamespace(configuration.input.topic)))
    return readExperiments(bag, complete, keep_going);
  if (experiment.mode == ExperimentMode::service)
    throw ConfigurationError(
        "experiment.mode: service: a bag does not record when the services were called; use mode "
        "topic, duration or gap");
  return readSignals(bag, configuration, keep_going);
}

}  // namespace

std::uint64_t unpackedSize(const std::string& path) { return BagFile(path).unpackedSize(); }

LoadedData readExperimentBag(const std::string& path) {
  BagFile bag(path);
  return readExperiments(bag, experimentTopics(bag), {});
}

LoadedData readBag(const std::string& path, const Configuration& configuration,
                   const KeepGoing& keep_going) {
  BagFile bag(path);
  return readFrom(bag, configuration, keep_going);
}

}  // namespace uncertainty_identification
