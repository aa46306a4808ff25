#pragma once

#include <chrono>
#include <limits>
#include <string>

namespace uncertainty_identification {

/// What a topic is read for. Markers come when something happens, the others as a stream.
enum class TopicRole { input, output, covariate, marker };

/// What a user wants to know about a topic that is listened to.
struct TopicActivity {
  std::string topic, key;  ///< key: what it is read for, in words
  TopicRole role = TopicRole::marker;
  long messages = 0;  ///< received
  long left_out = 0;  ///< of them, because they were broken or of a wrong type
  double rate = 0;    ///< [Hz] since it was asked for last
  double age = std::numeric_limits<double>::infinity();  ///< [s] since the newest arrived
  double interval = 0;  ///< [s] between messages, smoothed; 0 before the second
};

/// Counts the messages of a topic as they arrive, by wall time.
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

  /// When the newest one arrived.
  Clock::time_point newest() const { return newest_; }

  /// Fills in messages, rate, age and interval.
  void tell(Clock::time_point now, TopicActivity& activity) {
    const double elapsed = std::chrono::duration<double>(now - told_at_).count();
    activity.messages = messages_;
    activity.interval = interval_;
    if (elapsed > 0) activity.rate = static_cast<double>(messages_ - told_) / elapsed;
    if (messages_ > 0) activity.age = std::chrono::duration<double>(now - newest_).count();
    told_ = messages_;
    told_at_ = now;
  }

 private:
  long messages_ = 0, told_ = 0;
  double interval_ = 0;  // [s]
  Clock::time_point newest_, told_at_ = Clock::now();
};

}  // namespace uncertainty_identification
