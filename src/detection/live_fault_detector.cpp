#include "detection/live_fault_detector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "configuration/require.h"
#include "data/sample_grid.h"

namespace uncertainty_identification {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
constexpr int kFewestSamples = 10;  // in a piece; with fewer, resample() may not find its grid

/// The newest value of the signal at or before the instant; `otherwise` if there is none.
double heldAt(const StampedSignal& signal, double instant, double otherwise) {
  const auto after = std::upper_bound(signal.stamps.begin(), signal.stamps.end(), instant);
  if (after == signal.stamps.begin()) return otherwise;
  return signal.values[static_cast<std::size_t>(after - signal.stamps.begin() - 1)];
}

}  // namespace

void FaultDetectionConfiguration::validate() const {
  detection.validate();
  resampling.validate();
  require(!input.topic.empty(), "input.topic", "''", "a topic");
  require(!output.topic.empty(), "output.topic", "''", "a topic");
}

LiveFaultDetector::LiveFaultDetector(const Estimate& estimate,
                                     const FaultDetectionConfiguration& configuration)
    : options_(configuration.detection),
      detector_(estimate, options_),
      resampling_(configuration.resampling),
      active_(configuration.experiment_topic.empty()) {
  configuration.validate();
  setSampleTime(estimate);
}

void LiveFaultDetector::setSampleTime(const Estimate& estimate) {
  thinning_ = std::max(1, estimate.configuration.estimation.thinning);
  sample_time_ = detector_.sampleTime() / thinning_;
  piece_samples_ = std::max(kFewestSamples, options_.window * thinning_ / 5);
}

void LiveFaultDetector::adopt(const Estimate& estimate) {
  const double before = sample_time_;
  detector_ = FaultDetector(estimate, options_);
  setSampleTime(estimate);
  if (sample_time_ != before) interrupt();
  beginWindows();
}

/// The next window begins with the next sample.
void LiveFaultDetector::beginWindows() {
  group_ = {};
  instants_.clear();
  instants_first_ = 0;
  detector_.reset();
}

void LiveFaultDetector::addMarker(double stamp, bool active) {
  markers_.push_back({stamp, active});
}

void LiveFaultDetector::interrupt() {
  newest_.reset();
  last_input_ = {};
  beginWindows();
}

double LiveFaultDetector::heldInput(const Recording& piece, double instant) const {
  const double before = heldAt(last_input_, instant, newest_input_);
  return heldAt(piece.input, instant, before);
}

/// Processes the grid points between the newest sample and the first one of the piece. Their
/// outputs were not measured; their inputs are known from both pieces. After a long gap the inputs
/// are not known, and a new experiment begins.
void LiveFaultDetector::bridge(const Recording& piece, double until,
                               std::vector<StampedFaultWindow>* found) {
  const double begin = *newest_;
  const double missing = std::round((until - begin) / sample_time_) - 1;
  if (missing > 2.0 * piece_samples_) {
    interrupt();
    return;
  }
  for (int k = 1; k <= static_cast<int>(missing); ++k) {
    const double instant = begin + k * sample_time_;
    take(instant, heldInput(piece, instant + stampTolerance(instant, sample_time_)), kMissing,
         found);
  }
}

std::vector<StampedFaultWindow> LiveFaultDetector::add(const Recording& piece) {
  const Experiment samples = resample(piece, sample_time_, resampling_);
  std::vector<StampedFaultWindow> found;
  if (newest_ && samples.start_time < *newest_ - 0.5 * sample_time_) interrupt();
  if (newest_) bridge(piece, samples.start_time, &found);
  for (int k = 0; k < samples.samples(); ++k) {
    const double instant = samples.start_time + k * sample_time_;
    // If the true period is slightly below the sample time, pieces can overlap by one sample.
    if (newest_ && instant < *newest_ + 0.5 * sample_time_) continue;
    take(instant, samples.u[k], samples.isValid(k) ? samples.y[k] : kMissing, &found);
  }
  last_input_ = piece.input;
  return found;
}

void LiveFaultDetector::take(double instant, double u, double y,
                             std::vector<StampedFaultWindow>* found) {
  const double tolerance = stampTolerance(instant, sample_time_);
  while (!markers_.empty() && markers_.front().stamp <= instant + tolerance) {
    active_ = markers_.front().active;
    markers_.pop_front();
    beginWindows();
  }
  newest_ = instant;
  newest_input_ = u;
  if (!active_) return;
  if (group_.count == 0) group_ = {instant, y};
  group_.input += u;
  if (++group_.count < thinning_) return;
  const Group complete = std::exchange(group_, {});
  test(complete.instant, complete.input / thinning_, complete.y, found);
}

void LiveFaultDetector::test(double instant, double u, double y,
                             std::vector<StampedFaultWindow>* found) {
  instants_.push_back(instant);
  const auto window = detector_.add(u, y);
  if (!window) return;
  found->push_back(
      {*window, instants_[static_cast<std::size_t>(window->first - instants_first_)], instant});
  instants_first_ += static_cast<long>(instants_.size());
  instants_.clear();
}

}  // namespace uncertainty_identification
