#pragma once

#include <chrono>
#include <limits>
#include <string>

namespace uncertainty_identification {

/// What a topic is read for. Markers arrive only when something happens, the others as a stream.
enum class TopicRole { input, output, covariate, marker };

/// What a user wants to know about a topic that the node listens to.
struct TopicActivity {
  std::string topic;
  std::string key;  ///< what it is read for, in words: "input", "covariate 'temp'"
  TopicRole role = TopicRole::marker;
  long messages = 0;    ///< received
  long left_out = 0;    ///< of these, not used because they were broken or of a wrong type
  long not_finite = 0;  ///< samples that were NaN or infinite
  double rate = 0;      ///< [Hz] since the activity was asked for last
  double age = std::numeric_limits<double>::infinity();  ///< [s] since the newest message
  double interval = 0;  ///< [s] smoothed time between messages; 0 before the second message
};

/// Counts the messages of one topic as they arrive, by wall time.
class ArrivalCounter {
 public:
  using Clock = std::chrono::steady_clock;

  void count(Clock::time_point now) {
    constexpr double kSmoothing = 0.1;
    const double interval = std::chrono::duration<double>(now - newest_).count();
    if (messages_ == 1) interval_ = interval;
    if (messages_ > 1) interval_ += kSmoothing * (interval - interval_);
    ++messages_;
    newest_ = now;
  }

  /// When the newest message arrived.
  Clock::time_point newest() const { return newest_; }

  /// Sets messages, rate, age and interval of `activity`. The rate counts the messages since the
  /// last call.
  void fillIn(TopicActivity& activity, Clock::time_point now) {
    const double elapsed = std::chrono::duration<double>(now - asked_at_).count();
    activity.messages = messages_;
    activity.interval = interval_;
    if (elapsed > 0) activity.rate = static_cast<double>(messages_ - messages_asked_) / elapsed;
    if (messages_ > 0) activity.age = std::chrono::duration<double>(now - newest_).count();
    messages_asked_ = messages_;
    asked_at_ = now;
  }

 private:
  long messages_ = 0, messages_asked_ = 0;  // ..._asked_: as of the last fillIn()
  double interval_ = 0;                     // [s]
  Clock::time_point newest_, asked_at_ = Clock::now();
};

}  // namespace uncertainty_identification
