#include "ros/experiment_recorder.h"

#include <utility>

#include "ros/deserialise.h"
#include "ros/message_conversions.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

constexpr std::uint32_t kQueueLength =
    100000;  // messages; a burst is kept while the thread is busy
constexpr std::chrono::milliseconds kSilence(
    1000);                                 // after which nothing late is expected any more
constexpr std::size_t kMaxReported = 100;  // different problems

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
    : node_(node),
      configuration_(configuration),
      listener_(std::move(listener)),
      patience_(patience) {
  reset();
  std::set<std::string> topics;
  try {
    if (router_) {
      for (const auto& use : router_->uses()) topics.insert(use.topic);
    } else {
      topics.insert(node_.resolveName(experimentTopic(configuration, private_node)));
    }
  } catch (const ros::InvalidNameException& error) {
    throw ConfigurationError(std::string("a topic of the configuration: ") + error.what());
  }
  for (const auto& topic : topics) subscribe(topic);
  timer_ = node_.createWallTimer(ros::WallDuration(0.25), [this](const ros::WallTimerEvent&) {
    releaseAfterSilence();
    renewSubscriptions();
  });
}

void ExperimentRecorder::reset() {
  reported_.clear();
  if (configuration_.experiment.mode != ExperimentMode::message)
    router_ = std::make_unique<TopicRouter>(
        configuration_, [this](const std::string& topic) { return node_.resolveName(topic); });
  last_arrival_ = last_release_ = std::chrono::steady_clock::now();
  if (std::exchange(running_, false)) listener_.running(false);
}

void ExperimentRecorder::subscribe(const std::string& topic) {
  ros::SubscribeOptions options;
  options.initByFullCallbackType<const Event&>(
      topic, kQueueLength, [this, topic](const Event& event) { receive(topic, event); });
  options.transport_hints = ros::TransportHints().tcpNoDelay();
  topics_[topic].subscriber = node_.subscribe(options);
}

// To roscpp a subscription is of the type of its first publisher for ever, and refuses all others
// in silence: where a topic has lost its publishers it is subscribed to anew.
void ExperimentRecorder::renewSubscriptions() {
  const auto now = std::chrono::steady_clock::now();
  for (auto& [name, topic] : topics_) {
    const bool published = topic.subscriber.getNumPublishers() > 0;
    topic.connected = topic.connected || published;
    if (!topic.connected || published || now - topic.arrivals.newest() < kSilence) continue;
    topic.connected = false;
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
    }
  } else {
    activity.push_back({topics_.begin()->first, "experiment.topic", TopicRole::marker});
  }
  const auto now = std::chrono::steady_clock::now();
  for (auto& [name, topic] : topics_) {
    TopicActivity told;
    topic.arrivals.tell(now, told);
    for (auto& each : activity) {
      if (each.topic != name) continue;
      each.messages = told.messages;
      each.rate = told.rate;
      each.age = told.age;
      each.interval = told.interval;
    }
  }
  return activity;
}

void ExperimentRecorder::receive(const std::string& topic, const Event& event) {
  const auto& message = *event.getConstMessage();
  buffer_.resize(message.size());
  ros::serialization::OStream stream(buffer_.data(), static_cast<std::uint32_t>(buffer_.size()));
  message.write(stream);
  last_arrival_ = std::chrono::steady_clock::now();
  topics_[topic].arrivals.count(last_arrival_);
  topics_[topic].connected = true;
  try {
    record(topic, {message.getDataType(),
                   message.getMD5Sum(),
                   message.getMessageDefinition(),
                   {buffer_.data(), buffer_.size()},
                   event.getReceiptTime().toSec(),
                   event.getPublisherName()});
  } catch (const Error& error) {
    report(error.what());
  }
}

void ExperimentRecorder::record(const std::string& topic, const RawMessage& message) {
  if (!router_) {
    listener_.finished(
        fromMessage(deserialise<messages::Experiment>(message), configuration_.limits));
    return;
  }
  router_->add(topic, message);
  for (const auto& problem : router_->takeProblems()) report(problem);
  reportStamps();
  handOn();
}

bool ExperimentRecorder::start() {
  const bool done = router_ && router_->cutter().begin(ros::Time::now().toSec());
  handOn();
  return done;
}

bool ExperimentRecorder::finish() {
  const bool done = router_ && router_->cutter().finish(ros::Time::now().toSec());
  handOn();
  return done;
}

bool ExperimentRecorder::discard() {
  const bool done = router_ && router_->cutter().discard();
  handOn();
  return done;
}

// An experiment waits until both signals have passed its end; when the topics fall silent, they
// never will.
void ExperimentRecorder::releaseAfterSilence() {
  const auto now = std::chrono::steady_clock::now();
  const bool waiting = router_ && router_->cutter().waiting();
  const auto since = patience_ == Patience::a_second ? last_release_ : last_arrival_;
  if (!waiting) last_release_ = now;
  if (!waiting || now - since < kSilence) return;
  last_release_ = now;
  router_->cutter().releaseClosed();
  handOn();
}

void ExperimentRecorder::handOn() {
  if (!router_) return;
  ExperimentCutter& cutter = router_->cutter();
  for (auto& recording : cutter.takeFinished()) {
    last_release_ = std::chrono::steady_clock::now();
    listener_.finished(std::move(recording));
  }
  for (auto& rejected : cutter.takeRejected()) listener_.finished(std::move(rejected));
  if (std::exchange(running_, cutter.running()) != running_) listener_.running(running_);
}

void ExperimentRecorder::report(const std::string& problem) {
  if (reported_.size() < kMaxReported && reported_.insert(problem).second)
    listener_.problem(problem);
}

void ExperimentRecorder::reportStamps() {
  for (const auto& topic : router_->stampedOnReceipt())
    report("topic '" + topic +
           "' has no header, so that its samples are stamped on receipt; a replay can shift "
           "them by a sample: only reading the bag offline is exact");
}

}  // namespace uncertainty_identification
