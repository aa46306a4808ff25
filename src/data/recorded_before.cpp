#include "data/recorded_before.h"

#include <algorithm>
#include <functional>

#include "data/check.h"

namespace uncertainty_identification {
namespace {

std::uint64_t keyOf(const Experiment& experiment) {
  constexpr std::uint64_t kSpread = 0x9e3779b97f4a7c15;  // 2^64 divided by the golden ratio
  const std::uint64_t data = std::stoull(dataFingerprint({experiment}), nullptr, 16);
  return data ^ (kSpread * std::hash<double>()(experiment.start_time));
}

}  // namespace

bool RecordedBefore::add(const Experiment& experiment) {
  const std::uint64_t key = keyOf(experiment);
  if (!keys_.insert(key).second) return false;
  order_.push_back(key);
  if (order_.size() > kRemembered) {
    keys_.erase(order_.front());
    taken_out_.erase(order_.front());
    order_.pop_front();
  }
  return true;
}

void RecordedBefore::takeOut(const Experiment& experiment) {
  const std::uint64_t key = keyOf(experiment);
  if (keys_.count(key) > 0) taken_out_.insert(key);
}

bool RecordedBefore::readmit(const Experiment& experiment) {
  const std::uint64_t key = keyOf(experiment);
  if (keys_.count(key) == 0) return true;
  if (taken_out_.erase(key) == 0) return false;
  keys_.erase(key);
  order_.erase(std::find(order_.begin(), order_.end(), key));
  return true;
}

void RecordedBefore::clear() {
  keys_.clear();
  taken_out_.clear();
  order_.clear();
}

}  // namespace uncertainty_identification
