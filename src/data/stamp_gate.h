#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace uncertainty_identification {

/// Tells stray stamps of one signal from a clock that was reset. A sample whose stamp lies before
/// the newest, or far ahead of it, is held back until those that follow decide: if the old clock
/// goes on, it is dropped and counted; if three in a row do not continue the old clock, they are
/// passed on, and whoever receives them takes the clock for reset. A signal of which more than one
/// sample in twenty strays is passed on as it is. `Sample` has a member `stamp` [s].
template <class Sample>
class StampGate {
 public:
  /// Takes the next sample; returns those that can be used now, in the order in which they came.
  std::vector<Sample> pass(Sample sample) {
    if (!std::isfinite(sample.stamp)) return {std::move(sample)};
    if (!continues(sample.stamp)) {
      held_.push_back(std::move(sample));
      return held_.size() < kSustained && affordable() ? std::vector<Sample>() : release();
    }
    dropped_ += static_cast<int>(std::exchange(held_, {}).size());
    count(sample.stamp);
    return {std::move(sample)};
  }

  /// For a stamp [s] of the same clock, such as a marker's: where it is nearer to those held back
  /// than to the newest, they are passed on, as the clock was reset.
  std::vector<Sample> confirm(double stamp) {
    if (held_.empty()) return {};
    const double to_held = std::abs(stamp - held_.back().stamp);
    return to_held < std::abs(stamp - newest_) ? release() : std::vector<Sample>();
  }

  /// At the end, or when no more samples are to be waited for: those held back that lie ahead.
  /// Those that lie before the newest are dropped.
  std::vector<Sample> rest() {
    if (held_.empty()) return {};
    if (held_.front().stamp > newest_) return release();
    dropped_ += static_cast<int>(std::exchange(held_, {}).size());
    return {};
  }

  /// Number of samples dropped since the last call.
  int takeDropped() {
    all_dropped_ += dropped_;
    return std::exchange(dropped_, 0);
  }

 private:
  static constexpr std::size_t kSustained = 3;
  static constexpr int kShare = 20;                     // one sample in so many may stray
  static constexpr int kEnoughStamps = 10;              // from which the spacing is known
  static constexpr double kSpacings = 100, kLeast = 1;  // [s] a leap is longer than both

  bool continues(double stamp) const {
    if (passed_ == 0) return true;
    if (stamp < newest_ || passed_ < kEnoughStamps) return stamp >= newest_;
    return stamp - newest_ <= std::max(kLeast, kSpacings * (newest_ - first_) / (passed_ - 1));
  }

  bool affordable() const {
    const int strays = all_dropped_ + dropped_ + static_cast<int>(held_.size());
    return strays <= 1 + passed_ / kShare;
  }

  void count(double stamp) {
    if (passed_++ == 0) first_ = stamp;
    newest_ = stamp;
  }

  /// The samples held back are the clock's from now on.
  std::vector<Sample> release() {
    passed_ = 0;
    for (const Sample& sample : held_) count(sample.stamp);
    return std::exchange(held_, {});
  }

  std::vector<Sample> held_;
  double first_ = 0, newest_ = 0;      ///< [s] oldest and newest stamp of the present clock
  int passed_ = 0;                     ///< samples of the present clock
  int dropped_ = 0, all_dropped_ = 0;  ///< not yet taken, and taken
};

}  // namespace uncertainty_identification
