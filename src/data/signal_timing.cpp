#include "uncertainty_identification/data/signal_timing.h"

#include <cmath>
#include <utility>

#include "uncertainty_identification/data/recording.h"

namespace uncertainty_identification {

SignalTiming timingOf(const StampedSignal& signal) {
  SignalTiming timing;
  timing.lost = signal.lost;
  for (std::size_t i = 0; i < signal.arrivals.size(); ++i) {
    const double age = signal.arrivals[i] - signal.stamps[i];
    if (!std::isfinite(age)) continue;
    timing.age = age;
    timing.delay = std::fmin(timing.delay, age);  // fmin ignores a NaN
  }
  return timing;
}

long SequenceCounter::missingBefore(const std::string& publisher, std::uint32_t sequence) {
  constexpr std::size_t kMostPublishers = 1000;
  const auto known = last_.find(publisher);
  if (known == last_.end()) {
    if (last_.size() == kMostPublishers) last_.clear();
    last_.emplace(publisher, sequence);
    return 0;
  }
  const std::uint32_t before = std::exchange(known->second, sequence);
  return sequence <= before ? 0 : static_cast<long>(sequence - before) - 1;
}

}  // namespace uncertainty_identification
