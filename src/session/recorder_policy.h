#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <utility>

#include "data/experiment_cutter.h"
#include "session/experiment_intake.h"
#include "session/once_per_cause.h"

namespace uncertainty_identification {

/// Decides when a recorder passes on an experiment that has ended, and tells its listener what
/// happens. It is told the time, so that it can be tested without waiting. To be used from one
/// thread.
class RecorderPolicy {
 public:
  using Clock = std::chrono::steady_clock;

  struct Listener {
    std::function<void(FinishedExperiment)> finished;
    std::function<void(const std::string&)> problem;  ///< a message for the user; each cause once
    std::function<void(bool)> running;  ///< whether an experiment is running, when that changes
    /// This problem is over.
    std::function<void(const std::string&)> solved = [](const std::string&) {};
  };

  /// After an experiment has ended, late samples of both signals are waited for. This states how
  /// long.
  enum class Patience {
    until_silence,  ///< until both signals have passed the end, or all topics are silent for 1 s
    a_second        ///< at most 1 s: a command that rarely changes is not waited for
  };

  /// After this time without a message, no late message is expected any more.
  static constexpr std::chrono::milliseconds kSilence{1000};

  RecorderPolicy(Listener listener, Patience patience);

  /// Forgets the past, as when the node starts.
  void reset(Clock::time_point now);

  /// A message has arrived on any topic.
  void arrived(Clock::time_point now) { last_arrival_ = now; }

  /// Passes on what the cutter has finished or rejected, and tells whether an experiment is
  /// running.
  void passOn(ExperimentCutter& cutter, Clock::time_point now);

  /// Passes on an experiment that came complete in one message.
  void passOn(FinishedExperiment experiment) { listener_.finished(std::move(experiment)); }

  /// Makes the cutter release the experiments that have ended and have waited long enough for late
  /// samples, and passes them on. To be called a few times a second.
  void releaseLate(ExperimentCutter& cutter, Clock::time_point now);

  /// Tells the listener a problem unless one of the same cause was told before (OncePerCause).
  void report(const std::string& problem);

  /// Tells the listener that a problem is over. If it comes again it is told again.
  void solved(const std::string& problem);

  /// Whether an experiment is being recorded.
  bool running() const { return running_; }

 private:
  Listener listener_;
  Patience patience_;
  Clock::time_point last_arrival_;
  Clock::time_point wait_began_;  // [patience a_second] last release, or last time nothing waited
  OncePerCause reported_;
  bool running_ = false;
};

}  // namespace uncertainty_identification
