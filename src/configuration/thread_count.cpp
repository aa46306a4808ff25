#include "configuration/thread_count.h"

#include <algorithm>
#include <atomic>
#include <thread>

#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

namespace {

std::atomic<int> cores_left_free{1};

}  // namespace

int threadCount(int asked) {
  if (asked != kAutomatic) return asked;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - cores_left_free);
}

void useAllCores() { cores_left_free = 0; }

}  // namespace uncertainty_identification
