#include "data/experiment_cutter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "data/text.h"
#include "uncertainty_identification/errors.h"

// Takes in samples and cuts, and watches the clock. experiment_windows.cpp makes experiments of
// them.
namespace uncertainty_identification {

ExperimentCutter::ExperimentCutter(const ExperimentOptions& options, const LimitOptions& limits)
    : options_(options), max_samples_(static_cast<std::size_t>(std::max(1, limits.max_samples))) {
  if (options.mode == ExperimentMode::message) {
    throw ConfigurationError(
        "experiment.mode: with message, experiments arrive as a whole and no signals are cut; "
        "choose "
        "topic, service, duration or gap to cut signals");
  }
  if (options.mode == ExperimentMode::duration && !(options.duration > 0)) {
    throw ConfigurationError("experiment.duration: found " + text(options.duration) +
                             "; it must be above 0 s in mode duration");
  }
  if (options.mode == ExperimentMode::gap && !(options.gap > 0)) {
    throw ConfigurationError("experiment.gap: found " + text(options.gap) +
                             "; it must be above 0 s in mode gap");
  }
}

bool ExperimentCutter::cutsByCall() const {
  return options_.mode == ExperimentMode::topic || options_.mode == ExperimentMode::service;
}

void ExperimentCutter::addInput(double stamp, double value, const Arrival& arrival) {
  takeInput(input_gate_.pass({stamp, value, arrival}));
}

void ExperimentCutter::addOutput(double stamp, double value, const Arrival& arrival) {
  takeOutput(output_gate_.pass({stamp, value, arrival}));
}

void ExperimentCutter::addCovariate(const std::string& name, double stamp, double value) {
  takeCovariate(name, covariate_gates_[name].pass({stamp, value, {}}));
}

void ExperimentCutter::takeInput(const std::vector<Received>& samples) {
  for (const Received& sample : samples) {
    const double stamp = sample.stamp;
    if (before_ && ofOldClock(input_.newest(), stamp) && stamp >= before_->input_.newest()) {
      before_->takeInput({sample});
    } else {
      addSample("input", input_, stamp, sample.value, Duplicates::keep_last, sample.arrival);
    }
  }
}

void ExperimentCutter::takeOutput(const std::vector<Received>& samples) {
  for (const Received& sample : samples) {
    const double stamp = sample.stamp;
    if (before_ && ofOldClock(output_.newest(), stamp) && stamp >= before_->output_.newest()) {
      before_->takeOutput({sample});
    } else {
      addSample("output", output_, stamp, sample.value, Duplicates::keep_first, sample.arrival);
    }
  }
}

void ExperimentCutter::takeCovariate(const std::string& name,
                                     const std::vector<Received>& samples) {
  for (const Received& sample : samples) {
    addSample("covariate '" + name + "'", covariates_[name], sample.stamp, sample.value,
              Duplicates::keep_last);
  }
}

/// A marker or call tells of the clock, too.
void ExperimentCutter::confirmClock(double stamp) {
  takeInput(input_gate_.confirm(stamp));
  takeOutput(output_gate_.confirm(stamp));
  for (auto& [name, gate] : covariate_gates_) takeCovariate(name, gate.confirm(stamp));
}

/// Where no more samples are to be waited for.
void ExperimentCutter::takeHeldBack() {
  takeInput(input_gate_.rest());
  takeOutput(output_gate_.rest());
  for (auto& [name, gate] : covariate_gates_) takeCovariate(name, gate.rest());
}

void ExperimentCutter::addSample(const std::string& signal, StampedBuffer& buffer, double stamp,
                                 double value, Duplicates keep, const Arrival& arrival) {
  if (!acceptStamp(signal, buffer.newest(), stamp)) return;
  if (!buffer.push(stamp, value, keep, arrival)) ++duplicates_;
  advance();
}

void ExperimentCutter::addMarker(double stamp, bool active, const std::string& id) {
  if (options_.mode != ExperimentMode::topic) return;
  confirmClock(stamp);
  if (before_ && ofOldClock(newest_call_, stamp) && stamp >= before_->newest_call_) {
    before_->addMarker(stamp, active, id);
    advance();
    return;
  }
  if (!acceptStamp("marker", newest_call_, stamp)) return;
  newest_call_ = stamp;
  const bool renamed = marker_active_ && active && !id.empty() && id != marker_id_;
  if (marker_active_ && (!active || renamed)) finish(stamp);
  if (active && (!marker_active_ || renamed)) {
    begin(stamp, id);
    marker_id_ = id;
  }
  marker_active_ = active;
}

bool ExperimentCutter::begin(double stamp, const std::string& id) {
  if (!cutsByCall()) return false;
  confirmClock(stamp);
  if (!acceptStamp("call", newest_call_, stamp)) return false;
  newest_call_ = stamp;
  if (running()) return false;
  if (!windows_.empty()) windows_.back().end = std::min(windows_.back().end, stamp);
  openWindow(stamp, kEndless, id);
  advance();
  return true;
}

bool ExperimentCutter::finish(double stamp) {
  if (!cutsByCall()) return false;
  confirmClock(stamp);
  if (!acceptStamp("call", newest_call_, stamp)) return false;
  newest_call_ = stamp;
  if (!running()) return false;
  windows_.back().end = std::max(windows_.back().start, stamp);
  advance();
  return true;
}

bool ExperimentCutter::discard() {
  if (!cutsByCall() || !running()) return false;
  windows_.pop_back();
  return true;
}

bool ExperimentCutter::running() const { return !windows_.empty() && !ended(windows_.back()); }

bool ExperimentCutter::waiting() const {
  return before_ != nullptr || (!windows_.empty() && ended(windows_.front()));
}

/// Keeps track of the clock. False if the sample with this stamp must be left out.
bool ExperimentCutter::acceptStamp(const std::string& signal, double newest, double stamp) {
  if (!std::isfinite(stamp) || ofOldClock(newest, stamp)) {
    ++dropped_;
    return false;
  }
  if (stamp < newest) resetClock(signal, newest, stamp);
  now_ = std::max(now_, stamp);
  return true;
}

/// After the clock went back other signals may still deliver stamps of the old clock: a stamp that
/// is nearer to the old time than to the new one is taken for one of those, if the signal has shown
/// none of the new clock.
bool ExperimentCutter::ofOldClock(double newest, double stamp) const {
  return newest == kNever && stamp > old_clock_ && now_ < old_clock_;
}

/// Starts anew after the clock went back. Where a marker did not tell it, the marker that ended the
/// running experiment may still be on its way.
void ExperimentCutter::resetClock(const std::string& signal, double from, double to) {
  releaseOldClock();
  if (running()) {
    torn_ = "the clock went back while it was recorded (" + signal + " stamps from " + text(from) +
            " s to " + text(to) + " s); record it again without resetting the clock";
    if (options_.mode != ExperimentMode::topic || signal == "marker") rejectRunning();
  }
  LimitOptions limits;
  limits.max_samples = static_cast<int>(max_samples_);
  ExperimentCutter next(options_, limits);
  next.finished_ = takeFinished();
  next.rejected_ = takeRejected();
  next.begun_ = begun_;
  next.duplicates_ = duplicates_;
  next.clock_resets_ = clock_resets_ + 1;
  next.dropped_ = dropped_;
  next.old_clock_ = now_ + 0.5 * (to - now_);
  next.now_ = to;
  next.input_gate_ = std::exchange(input_gate_, {});
  next.output_gate_ = std::exchange(output_gate_, {});
  next.covariate_gates_ = std::exchange(covariate_gates_, {});
  if (!windows_.empty()) next.before_ = std::make_unique<ExperimentCutter>(std::move(*this));
  *this = std::move(next);
}

void ExperimentCutter::rejectRunning() {
  const std::string& id = windows_.back().id;
  rejected_.push_back({id, named(id) + ": " + torn_});
  windows_.pop_back();
}

/// Releases the closed experiments of the old clock, with the samples that they have, and rejects
/// the one whose end has not been told.
void ExperimentCutter::releaseOldClock() {
  if (!before_) return;
  before_->releaseClosed();
  if (before_->running()) before_->rejectRunning();
  for (Recording& recording : before_->takeFinished()) finished_.push_back(std::move(recording));
  for (auto& rejected : before_->takeRejected()) rejected_.push_back(std::move(rejected));
  before_.reset();
}

std::vector<Recording> ExperimentCutter::takeFinished() { return std::exchange(finished_, {}); }

std::vector<RejectedExperiment> ExperimentCutter::takeRejected() {
  return std::exchange(rejected_, {});
}

}  // namespace uncertainty_identification
