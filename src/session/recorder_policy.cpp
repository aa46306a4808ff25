#include "session/recorder_policy.h"

#include <utility>

namespace uncertainty_identification {

RecorderPolicy::RecorderPolicy(Listener listener, Patience patience)
    : listener_(std::move(listener)), patience_(patience) {}

void RecorderPolicy::reset(Clock::time_point now) {
  reported_.forget();
  last_arrival_ = wait_began_ = now;
  if (std::exchange(running_, false)) listener_.running(false);
}

void RecorderPolicy::passOn(ExperimentCutter& cutter, Clock::time_point now) {
  for (auto& recording : cutter.takeFinished()) {
    wait_began_ = now;
    listener_.finished(std::move(recording));
  }
  for (auto& rejected : cutter.takeRejected()) listener_.finished(std::move(rejected));
  if (std::exchange(running_, cutter.running()) != running_) listener_.running(running_);
}

void RecorderPolicy::releaseLate(ExperimentCutter& cutter, Clock::time_point now) {
  if (!cutter.waiting()) {
    wait_began_ = now;
    return;
  }
  const auto since = patience_ == Patience::a_second ? wait_began_ : last_arrival_;
  if (now - since < kSilence) return;
  wait_began_ = now;
  cutter.releaseClosed();
  passOn(cutter, now);
}

void RecorderPolicy::report(const std::string& problem) {
  if (reported_.isNew(problem)) listener_.problem(problem);
}

void RecorderPolicy::solved(const std::string& problem) {
  reported_.forget(problem);
  listener_.solved(problem);
}

}  // namespace uncertainty_identification
