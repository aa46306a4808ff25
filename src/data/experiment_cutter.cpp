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
  addSample("input", input_, stamp, value, Duplicates::keep_last, arrival);
}

void ExperimentCutter::addOutput(double stamp, double value, const Arrival& arrival) {
  addSample("output", output_, stamp, value, Duplicates::keep_first, arrival);
}

void ExperimentCutter::addCovariate(const std::string& name, double stamp, double value) {
  addSample("covariate '" + name + "'", covariates_[name], stamp, value, Duplicates::keep_last);
}

void ExperimentCutter::addSample(const std::string& signal, StampedBuffer& buffer, double stamp,
                                 double value, Duplicates keep, const Arrival& arrival) {
  if (!acceptStamp(signal, buffer.newest(), stamp)) return;
  if (!buffer.push(stamp, value, keep, arrival)) ++duplicates_;
  advance();
}

void ExperimentCutter::addMarker(double stamp, bool active, const std::string& id) {
  if (options_.mode != ExperimentMode::topic || !acceptStamp("marker", newest_call_, stamp)) return;
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
  if (!cutsByCall() || !acceptStamp("call", newest_call_, stamp)) return false;
  newest_call_ = stamp;
  if (running()) return false;
  if (!windows_.empty()) windows_.back().end = std::min(windows_.back().end, stamp);
  openWindow(stamp, kEndless, id);
  advance();
  return true;
}

bool ExperimentCutter::finish(double stamp) {
  if (!cutsByCall() || !acceptStamp("call", newest_call_, stamp)) return false;
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

bool ExperimentCutter::waiting() const { return !windows_.empty() && ended(windows_.front()); }

/// Keeps track of the clock. False if the sample with this stamp must be left out.
bool ExperimentCutter::acceptStamp(const std::string& signal, double newest, double stamp) {
  const bool of_old_clock = newest == kNever && stamp > old_clock_ && now_ < old_clock_;
  if (!std::isfinite(stamp) || of_old_clock) {
    ++dropped_;
    return false;
  }
  if (stamp < newest) resetClock(signal, newest, stamp);
  now_ = std::max(now_, stamp);
  return true;
}

/// Starts anew after the clock went back. Other signals may still deliver stamps of the old clock:
/// a stamp that is nearer to the old time than to the new one is taken for one of those.
void ExperimentCutter::resetClock(const std::string& signal, double from, double to) {
  releaseClosed();
  for (const Window& window : windows_) {
    rejected_.push_back({window.id, named(window.id) +
                                        ": the clock went back while it was recorded (" + signal +
                                        " stamps from " + text(from) + " s to " + text(to) +
                                        " s); record it again without resetting the clock"});
  }
  windows_.clear();
  input_.clear();
  output_.clear();
  for (auto& [name, buffer] : covariates_) buffer.clear();
  ++clock_resets_;
  marker_active_ = false;
  newest_call_ = first_window_ = released_until_ = activity_ = kNever;
  old_clock_ = now_ + 0.5 * (to - now_);
  now_ = to;
}

std::vector<Recording> ExperimentCutter::takeFinished() { return std::exchange(finished_, {}); }

std::vector<RejectedExperiment> ExperimentCutter::takeRejected() {
  return std::exchange(rejected_, {});
}

}  // namespace uncertainty_identification
