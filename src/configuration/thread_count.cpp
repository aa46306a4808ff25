#include "configuration/thread_count.h"

#include <algorithm>
#include <thread>

#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

int threadCount(int asked) {
  if (asked != kAutomatic) return asked;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1);
}

}  // namespace uncertainty_identification
