#pragma once

#include <chrono>

namespace uncertainty_identification {

/// Measures wall time since its construction.
class Stopwatch {
 public:
  /// Elapsed time [s].
  double seconds() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point began_ = Clock::now();
};

}  // namespace uncertainty_identification
