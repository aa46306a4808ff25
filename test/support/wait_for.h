#pragma once

#include <chrono>
#include <thread>

namespace uncertainty_identification {

/// Waits until the condition holds. False when it does not within the limit, which is generous: it
/// is never waited for when all is well.
template <typename Condition>
bool waitFor(const Condition& condition, std::chrono::seconds limit = std::chrono::seconds(120)) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

}  // namespace uncertainty_identification
