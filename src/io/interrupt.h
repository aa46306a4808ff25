#pragma once

#include <csignal>

namespace uncertainty_identification {

/// While one exists, Ctrl-C or SIGTERM asks the program to stop instead of killing it; a second one
/// kills it. One at a time.
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
