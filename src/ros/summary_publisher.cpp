#include "ros/summary_publisher.h"

#include <cmath>
#include <exception>
#include <limits>
#include <utility>

#include "ros/message_conversions.h"
#include "session/result_overview.h"

namespace uncertainty_identification {
namespace {

messages::PhysicalNumber numberOf(const PhysicalNumbers& physical, const std::string& name) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  const PhysicalNumber number =
      findNumber(physical, name).value_or(PhysicalNumber{name, "", kUnknown});
  messages::PhysicalNumber message;
  message.value = number.value;
  message.lower = number.lower.value_or(kUnknown);
  message.upper = number.upper.value_or(kUnknown);
  message.spread = number.spread.value_or(kUnknown);
  return message;
}

}  // namespace

messages::Summary toMessage(const Result& result, const ResultContext& context, int rejected) {
  messages::Summary message;
  message.header.stamp = stampOf(context);
  message.sequence = context.sequence;
  message.preliminary = context.preliminary;
  message.trusted = result.estimate.trust.trusted;
  message.static_gain = numberOf(result.physical, "gain");
  message.time_constant = numberOf(result.physical, "time_constant");
  message.bandwidth = numberOf(result.physical, "bandwidth");
  message.dead_time = numberOf(result.physical, "dead_time");
  message.noise_standard_deviation = std::sqrt(result.estimate.noise_variance.value);
  message.fit = typicalFit(result.runs);
  message.accepted = static_cast<std::uint32_t>(result.estimate.experiment_count);
  message.rejected = static_cast<std::uint32_t>(rejected);
  return message;
}

SummaryPublisher::SummaryPublisher(ros::NodeHandle node, Begins begins, Done done)
    : begins_(std::move(begins)),
      done_(std::move(done)),
      publisher_(node.advertise<messages::Summary>("summary", 1, true)),
      thread_([this] { run(); }) {}

SummaryPublisher::~SummaryPublisher() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void SummaryPublisher::add(const WorkerResult& result, const ResultContext& context) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    newest_ = Request{result, context};
  }
  changed_.notify_one();
}

std::optional<Result> SummaryPublisher::resultOf(std::uint32_t sequence) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return last_sequence_ == sequence ? last_ : std::nullopt;
}

void SummaryPublisher::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return stopping_ || newest_; });
    if (stopping_) return;
    const Request request = *std::exchange(newest_, std::nullopt);
    lock.unlock();
    publish(request);
    lock.lock();
  }
}

void SummaryPublisher::publish(const Request& request) {
  const auto& [made, context] = request;
  const auto running =
      begins_("computing the summary of result " + std::to_string(context.sequence));
  Result result{*made.estimate, {}};
  try {
    addOverview(made.kept, &result);
    publisher_.publish(toMessage(result, context, made.rejected));
  } catch (const std::exception& error) {  // costs only the summary; the node keeps running
    ROS_WARN_STREAM("result " << context.sequence << " has no summary: " << error.what());
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    last_ = result;
    last_sequence_ = context.sequence;
  }
  done_(result, context);
}

}  // namespace uncertainty_identification
