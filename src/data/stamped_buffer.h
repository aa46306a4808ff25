#pragma once

#include <cstddef>
#include <deque>
#include <limits>

#include "uncertainty_identification/data/recording.h"
#include "uncertainty_identification/data/signal_timing.h"

namespace uncertainty_identification {

/// Samples of one signal in order of their stamps, kept until they are cut into experiments.
class StampedBuffer {
 public:
  static constexpr double kNever = -std::numeric_limits<double>::infinity();

  /// Appends a sample; its stamp must not be smaller than the newest. False if both are equal: then
  /// `keep` says which of the two samples is kept, and the other is counted as its duplicate.
  bool push(double stamp, double value, Duplicates keep = Duplicates::keep_first,
            const Arrival& arrival = {});

  /// Newest stamp since the last clear() [s], also of samples that were forgotten since; kNever if
  /// there is none.
  double newest() const { return newest_; }

  /// Oldest stamp kept [s]; kNever if there is none.
  double oldest() const { return samples_.empty() ? kNever : samples_.front().stamp; }

  /// Smallest stamp kept that is at or after (above: strictly after) `stamp` [s]; infinity if there
  /// is none.
  double firstFrom(double stamp) const;
  double firstAbove(double stamp) const;

  /// Stamp of the sample that follows `count` samples at or after `start` [s]; infinity if there
  /// are no more than those.
  double stampAfter(double start, std::size_t count) const;

  std::size_t size() const { return samples_.size(); }

  /// The samples with start <= stamp < end, and with `held` the newest one before the start, unless
  /// one is stamped at it. Adds the duplicates counted with them to `duplicates`.
  StampedSignal copy(double start, double end, bool held, int& duplicates) const;

  /// Drops the samples before `start` [s]; with `held` those that copy(start, ..., true) would not
  /// use.
  void forgetBefore(double start, bool held);

  /// Drops the oldest samples until `count` are left.
  void forgetAllBut(std::size_t count);

  /// Forgets everything, also which stamp was the newest.
  void clear();

 private:
  struct Sample {
    double stamp, value;
    Arrival arrival;
    int duplicates;
  };
  using Iterator = std::deque<Sample>::const_iterator;
  Iterator from(double stamp) const;
  Iterator above(double stamp) const;

  std::deque<Sample> samples_;
  double newest_ = kNever;
};

}  // namespace uncertainty_identification
