#pragma once

#include <csignal>

namespace uncertainty_identification {

/// While a guard exists, the first Ctrl-C or SIGTERM is a request to stop, which requested()
/// reports; the second one kills the program. At most one guard may exist at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  /// Whether the user asked to stop.
  bool requested() const;

 private:
  struct sigaction interrupt_before_, terminate_before_;
};

}  // namespace uncertainty_identification
