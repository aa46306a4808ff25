#include "data/stamped_buffer.h"

#include <algorithm>

namespace uncertainty_identification {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

}  // namespace

bool StampedBuffer::push(double stamp, double value, Duplicates keep, const Arrival& arrival) {
  if (stamp == newest_) {
    if (samples_.empty()) return false;
    ++samples_.back().duplicates;
    samples_.back().arrival.lost += arrival.lost;
    if (keep == Duplicates::keep_last) samples_.back().value = value;
    return false;
  }
  samples_.push_back({stamp, value, arrival, 0});
  newest_ = stamp;
  return true;
}

StampedBuffer::Iterator StampedBuffer::from(double stamp) const {
  return std::lower_bound(samples_.begin(), samples_.end(), stamp,
                          [](const Sample& sample, double limit) { return sample.stamp < limit; });
}

StampedBuffer::Iterator StampedBuffer::above(double stamp) const {
  return std::upper_bound(samples_.begin(), samples_.end(), stamp,
                          [](double limit, const Sample& sample) { return limit < sample.stamp; });
}

double StampedBuffer::firstFrom(double stamp) const {
  const auto found = from(stamp);
  return found == samples_.end() ? kEndless : found->stamp;
}

double StampedBuffer::firstAbove(double stamp) const {
  const auto found = above(stamp);
  return found == samples_.end() ? kEndless : found->stamp;
}

double StampedBuffer::stampAfter(double start, std::size_t count) const {
  if (samples_.size() <= count) return kEndless;
  const auto left = static_cast<std::size_t>(samples_.end() - from(start));
  return left > count ? samples_[samples_.size() - left + count].stamp : kEndless;
}

StampedSignal StampedBuffer::copy(double start, double end, bool held, int& duplicates) const {
  auto first = from(start);
  if (held && first != samples_.begin() && (first == samples_.end() || first->stamp > start))
    --first;
  StampedSignal signal;
  for (auto sample = first; sample != samples_.end() && sample->stamp < end; ++sample) {
    signal.stamps.push_back(sample->stamp);
    signal.values.push_back(sample->value);
    signal.arrivals.push_back(sample->arrival.time);
    if (sample->stamp >= start) signal.lost += sample->arrival.lost;
    duplicates += sample->duplicates;
  }
  return signal;
}

void StampedBuffer::forgetBefore(double start, bool held) {
  if (held) {
    while (samples_.size() > 1 && samples_[1].stamp <= start) samples_.pop_front();
  } else {
    while (!samples_.empty() && samples_.front().stamp < start) samples_.pop_front();
  }
}

void StampedBuffer::forgetAllBut(std::size_t count) {
  while (samples_.size() > count) samples_.pop_front();
}

void StampedBuffer::clear() {
  samples_.clear();
  newest_ = kNever;
}

}  // namespace uncertainty_identification
