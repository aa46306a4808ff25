#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "data/experiment_cutter.h"

// Decides when experiments begin, end and are released. experiment_cutter.cpp takes in the samples.
namespace uncertainty_identification {

/// Brings the windows up to date with the samples.
void ExperimentCutter::advance() {
  if (before_ && !oldClockAwaited()) releaseOldClock();
  for (;;) {
    if (options_.mode == ExperimentMode::duration && windows_.empty()) openDurationWindow();
    if (options_.mode == ExperimentMode::gap)
      followActivity(std::min(input_.newest(), output_.newest()));
    closeFull();
    if (windows_.empty()) break;
    const Window& front = windows_.front();
    const bool complete = input_.newest() >= front.end && output_.newest() >= front.end;
    if (!complete && !(crowded() && ended(front))) break;
    releaseFront();
  }
  boundMemory();
}

/// Whether the old clock may still bring something: the end of the experiment that ran, until a
/// marker shows the new clock; samples of a closed one, until both signals have shown it.
bool ExperimentCutter::oldClockAwaited() const {
  if (before_->running()) return newest_call_ == kNever && now_ < old_clock_;
  return before_->waiting() && (input_.newest() == kNever || output_.newest() == kNever);
}

/// Whether so many samples are kept that the front experiment is released without waiting any
/// longer for the other signal, e.g. for an input that has died.
bool ExperimentCutter::crowded() const {
  return std::max(input_.size(), output_.size()) > 2 * max_samples_;
}

void ExperimentCutter::openWindow(double start, double end, const std::string& id) {
  char counted[32];
  std::snprintf(counted, sizeof counted, "experiment_%03ld", begun_++);
  windows_.push_back({id.empty() ? counted : id, start, end, ""});
}

/// Opens the window that contains the oldest output that was in no window so far.
void ExperimentCutter::openDurationWindow() {
  if (first_window_ == kNever) {
    if (input_.size() == 0 || output_.size() == 0) return;
    first_window_ = std::max(input_.oldest(), output_.oldest());
  }
  const double next = output_.firstFrom(std::max(first_window_, released_until_));
  if (next == kEndless) return;
  const double length = options_.duration;
  double index = std::floor((next - first_window_) / length);
  if (next >= first_window_ + (index + 1) * length) ++index;  // the quotient was rounded down
  if (next < first_window_ + index * length) --index;         // the quotient was rounded up
  openWindow(std::max(first_window_ + index * length, released_until_),
             first_window_ + (index + 1) * length);
}

/// Mode gap: goes through the stamps of both signals up to `known_until` [s]; later than that, more
/// stamps may still arrive.
void ExperimentCutter::followActivity(double known_until) {
  for (;;) {
    const double next = std::min(input_.firstAbove(activity_), output_.firstAbove(activity_));
    if (next > known_until || next == kEndless) return;
    const bool silence = next - activity_ > options_.gap;
    if (!windows_.empty() && silence) windows_.back().end = std::min(windows_.back().end, next);
    if (windows_.empty() || windows_.back().end <= next) openWindow(next, kEndless);
    activity_ = next;
  }
}

/// Ends the oldest experiment at the sample with which it reaches max_samples.
void ExperimentCutter::closeFull() {
  if (windows_.empty()) return;
  Window& window = windows_.front();
  double full = std::min(input_.stampAfter(window.start, max_samples_),
                         output_.stampAfter(window.start, max_samples_));
  for (const auto& [name, buffer] : covariates_)
    full = std::min(full, buffer.stampAfter(window.start, max_samples_));
  if (full >= window.end) return;
  window.end = full;
  window.note = "it was ended when it reached max_samples (" + std::to_string(max_samples_) + ")";
}

void ExperimentCutter::releaseFront() {
  const Window window = std::move(windows_.front());
  windows_.pop_front();
  Recording recording;
  recording.id = window.id;
  recording.start = window.start;
  recording.end = window.end;
  recording.note = window.note;
  recording.stray_stamps = input_gate_.takeDropped() + output_gate_.takeDropped();
  for (auto& [name, gate] : covariate_gates_) recording.stray_stamps += gate.takeDropped();
  recording.input = input_.copy(window.start, window.end, true, recording.duplicate_stamps);
  recording.output = output_.copy(window.start, window.end, false, recording.duplicate_stamps);
  for (const auto& [name, buffer] : covariates_) {
    StampedSignal signal = buffer.copy(window.start, window.end, true, recording.duplicate_stamps);
    if (!signal.stamps.empty()) recording.covariates.emplace(name, std::move(signal));
  }
  input_.forgetBefore(window.end, true);
  output_.forgetBefore(window.end, false);
  for (auto& [name, buffer] : covariates_) buffer.forgetBefore(window.end, true);
  released_until_ = window.end;
  finished_.push_back(std::move(recording));
}

void ExperimentCutter::releaseClosed() {
  takeHeldBack();
  releaseOldClock();
  while (waiting()) releaseFront();
  advance();
}

void ExperimentCutter::flush() {
  takeHeldBack();
  releaseOldClock();
  if (options_.mode == ExperimentMode::gap) followActivity(kEndless);
  advance();
  while (!windows_.empty()) {
    Window& window = windows_.front();
    if (cutsByCall() && !ended(window)) window.note = "the data ended while it was running";
    if (window.end == kEndless) window.end = std::nextafter(now_, kEndless);
    releaseFront();
    advance();
  }
  marker_active_ = false;
  first_window_ = kNever;
}

/// Drops samples that no experiment can need any more. Between experiments, up to twice max_samples
/// are kept, because the marker of their experiment may be late.
void ExperimentCutter::boundMemory() {
  const bool begun = !windows_.empty();
  const auto bound = [&](StampedBuffer& buffer, bool held) {
    if (begun) buffer.forgetBefore(windows_.front().start, held);
    buffer.forgetAllBut(2 * max_samples_ + 1);
  };
  bound(input_, true);
  bound(output_, false);
  for (auto& [name, buffer] : covariates_) bound(buffer, true);
}

}  // namespace uncertainty_identification
