#include "ros/experiment_recorder.h"

#include <set>
#include <utility>

#include "ros/deserialise.h"
#include "ros/message_conversions.h"
#include "ros/start_checks.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

// Messages that ROS keeps while the thread is busy; more than a burst of the fastest topics.
constexpr std::uint32_t kQueueLength = 100000;
constexpr double kPolicyPeriod = 0.25;  // [s] between two checks whether an experiment is due

std::string experimentTopic(const Configuration& configuration,
                            const ros::NodeHandle& private_node) {
  const std::string& topic = configuration.experiment.topic;
  return topic == ExperimentOptions().topic ? private_node.resolveName("experiment") : topic;
}

}  // namespace

ExperimentRecorder::ExperimentRecorder(const ros::NodeHandle& node,
                                       const ros::NodeHandle& private_node,
                                       const Configuration& configuration, Listener listener,
                                       Patience patience)
    : node_(node), configuration_(configuration), policy_(std::move(listener), patience) {
  requireTopics(configuration,
                [this](const std::string& topic) { return node_.resolveName(topic); });
  std::set<std::string> topics;
  reset();
  if (router_) {
    for (const auto& use : router_->uses()) topics.insert(use.topic);
  } else {
    topics.insert(node_.resolveName(experimentTopic(configuration, private_node)));
  }
  for (const auto& topic : topics) subscribe(topic);
  timer_ =
      node_.createWallTimer(ros::WallDuration(kPolicyPeriod), [this](const ros::WallTimerEvent&) {
        if (router_) policy_.releaseLate(router_->cutter(), Clock::now());
        renewSubscriptions();
      });
}

void ExperimentRecorder::reset() {
  if (configuration_.experiment.mode != ExperimentMode::message)
    router_ = std::make_unique<TopicRouter>(
        configuration_, [this](const std::string& topic) { return node_.resolveName(topic); });
  policy_.reset(Clock::now());
}

void ExperimentRecorder::subscribe(const std::string& topic) {
  ros::SubscribeOptions options;
  options.initByFullCallbackType<const Event&>(
      topic, kQueueLength, [this, topic](const Event& event) { receive(topic, event); });
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  topics_[topic].subscriber = node_.subscribe(options);
}

// A roscpp subscription takes the message type of its first publisher and then silently ignores
// publishers of other types. A topic that has lost all its publishers is therefore subscribed to
// again, so that a publisher of another type is heard.
void ExperimentRecorder::renewSubscriptions() {
  const auto now = Clock::now();
  for (auto& [name, topic] : topics_) {
    const bool published = topic.subscriber.getNumPublishers() > 0;
    topic.had_publisher = topic.had_publisher || published;
    if (!topic.had_publisher || published ||
        now - topic.arrivals.newest() < RecorderPolicy::kSilence)
      continue;
    topic.had_publisher = false;
    topic.subscriber.shutdown();
    subscribe(name);
  }
}

std::vector<TopicActivity> ExperimentRecorder::activity() {
  std::vector<TopicActivity> activity;
  if (router_) {
    for (const auto& use : router_->uses()) {
      activity.push_back({use.topic, use.key, use.role});
      activity.back().left_out = use.left_out;
      activity.back().not_finite = use.not_finite;
    }
  } else {
    activity.push_back({topics_.begin()->first, "experiment.topic", TopicRole::marker});
  }
  const auto now = Clock::now();
  for (auto& [name, topic] : topics_) {
    TopicActivity arrived;
    topic.arrivals.fillIn(arrived, now);
    for (auto& each : activity) {
      if (each.topic != name) continue;
      each.messages = arrived.messages;
      each.rate = arrived.rate;
      each.age = arrived.age;
      each.interval = arrived.interval;
    }
  }
  return activity;
}

void ExperimentRecorder::receive(const std::string& topic, const Event& event) {
  const auto& message = *event.getConstMessage();
  buffer_.resize(message.size());
  ros::serialization::OStream stream(buffer_.data(), static_cast<std::uint32_t>(buffer_.size()));
  message.write(stream);
  const auto now = Clock::now();
  policy_.arrived(now);
  topics_[topic].arrivals.count(now);
  topics_[topic].had_publisher = true;
  try {
    record(topic, {message.getDataType(),
                   message.getMD5Sum(),
                   message.getMessageDefinition(),
                   {buffer_.data(), buffer_.size()},
                   event.getReceiptTime().toSec(),
                   event.getPublisherName()});
    if (const std::string over = std::exchange(topics_[topic].refused, ""); !over.empty())
      policy_.solved(over);
  } catch (const ConfigurationError& error) {
    topics_[topic].refused = error.what();
    policy_.report(error.what());
  } catch (const Error& error) {
    policy_.report(error.what());
  }
}

void ExperimentRecorder::record(const std::string& topic, const RawMessage& message) {
  if (!router_) {
    policy_.passOn(fromMessage(deserialise<messages::Experiment>(message), configuration_.limits));
    return;
  }
  router_->add(topic, message);
  for (const auto& problem : router_->takeProblems()) policy_.report(problem);
  reportStamps();
  passOn();
}

bool ExperimentRecorder::start() {
  const bool done = router_ && router_->cutter().begin(ros::Time::now().toSec());
  passOn();
  return done;
}

bool ExperimentRecorder::finish() {
  const bool done = router_ && router_->cutter().finish(ros::Time::now().toSec());
  passOn();
  return done;
}

bool ExperimentRecorder::discard() {
  const bool done = router_ && router_->cutter().discard();
  passOn();
  return done;
}

void ExperimentRecorder::passOn() {
  if (router_) policy_.passOn(router_->cutter(), Clock::now());
}

void ExperimentRecorder::reportStamps() {
  for (const auto& topic : router_->stampedOnReceipt())
    policy_.report("topic '" + topic +
                   "' has no header, so its samples are stamped on receipt; a replay can shift "
                   "them by a sample: only reading the bag offline is exact");
}

}  // namespace uncertainty_identification
