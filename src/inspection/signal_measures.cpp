#include "inspection/signal_measures.h"

#include <algorithm>
#include <cmath>

#include "data/bandwidth.h"
#include "inspection/held_signal.h"
#include "inspection/resolution.h"

namespace uncertainty_identification {
namespace {

constexpr long kMostLevels = 1000, kFewLevels = 20;
constexpr double kMostlyHeld = 0.5;  // share of repeats from which a signal may be one of steps
constexpr double kLeap = 0.05;       // [range] a change as large is no movement but a step
constexpr double kClipped = 0.005;   // share of samples at an extreme that is no coincidence
constexpr long kStay = 3;            // samples at an extreme that follow each other
constexpr std::size_t kShortest = 32;
constexpr double kLongestSpectrum = 1 << 18;  // of the spectrum

/// What a pass over the samples counts.
struct Counts {
  long samples = 0, pairs = 0, held = 0, at_smallest = 0, at_largest = 0;
  std::vector<double> changes;
};

/// Samples within runs of at least kStay at `extreme`.
long stayingAt(const std::vector<double>& values, double extreme, double tolerance) {
  long staying = 0, run = 0;
  for (std::size_t i = 0; i <= values.size(); ++i) {
    if (i < values.size() && std::abs(values[i] - extreme) <= tolerance) {
      ++run;
      continue;
    }
    if (run >= kStay) staying += run;
    run = 0;
  }
  return staying;
}

Counts countsOf(const Channel& channel, double smallest, double largest, double tolerance) {
  Counts counts;
  for (const StampedSignal& record : channel.records) {
    const std::vector<double>& values = record.values;
    counts.samples += static_cast<long>(values.size());
    counts.at_smallest += stayingAt(values, smallest, tolerance);
    counts.at_largest += stayingAt(values, largest, tolerance);
    for (std::size_t i = 1; i < values.size(); ++i) {
      ++counts.pairs;
      const double change = std::abs(values[i] - values[i - 1]);
      if (change <= tolerance)
        ++counts.held;
      else
        counts.changes.push_back(change);
    }
  }
  return counts;
}

double middleOf(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

SignalShape shapeOf(const SignalMeasures& measures, double typical_change) {
  if (measures.levels < 2) return SignalShape::constant;
  if (measures.levels == 2) return SignalShape::two_levels;
  const double leap = kLeap * (measures.largest - measures.smallest);
  const bool leaps = measures.levels <= kFewLevels || typical_change > leap;
  return measures.held >= kMostlyHeld && leaps ? SignalShape::steps : SignalShape::continuous;
}

std::vector<double> allValues(const Channel& channel) {
  std::vector<double> values;
  for (const StampedSignal& record : channel.records)
    values.insert(values.end(), record.values.begin(), record.values.end());
  return values;
}

/// The record with the most samples.
const StampedSignal* longestRecord(const Channel& channel) {
  const auto longest = std::max_element(
      channel.records.begin(), channel.records.end(),
      [](const auto& left, const auto& right) { return left.values.size() < right.values.size(); });
  return longest == channel.records.end() ? nullptr : &*longest;
}

}  // namespace

std::optional<double> bandHertz(const Channel& channel) {
  const StampedSignal* record = longestRecord(channel);
  if (record == nullptr || record->values.size() < kShortest) return std::nullopt;
  const StampSummary stamps = summaryOf(record->stamps);
  const double length = stamps.period > 0 ? (stamps.end - stamps.start) / stamps.period + 1 : 0;
  if (!(length >= kShortest)) return std::nullopt;
  const double thinned = std::max(1.0, std::ceil(length / kLongestSpectrum));
  const double period = stamps.period * thinned;
  const Eigen::VectorXd signal =
      heldSignal(*record, stamps.start, period, static_cast<Eigen::Index>(length / thinned));
  if (!(signal.maxCoeff() > signal.minCoeff())) return std::nullopt;
  return bandwidth(signal) / period;
}

SignalMeasures measure(const Channel& channel) {
  SignalMeasures measures;
  const std::vector<double> levels = levelsOf(allValues(channel));
  if (levels.empty()) return measures;
  measures.smallest = levels.front();
  measures.largest = levels.back();
  measures.levels = std::min(kMostLevels, static_cast<long>(levels.size()));
  measures.resolution = resolutionOf(levels);
  const Counts counts =
      countsOf(channel, levels.front(), levels.back(), 0.01 * measures.resolution);
  const auto share = [](long part, long all) {
    return all > 0 ? static_cast<double>(part) / static_cast<double>(all) : 0;
  };
  measures.samples = counts.samples;
  measures.held = share(counts.held, counts.pairs);
  measures.at_smallest = share(counts.at_smallest, counts.samples);
  measures.at_largest = share(counts.at_largest, counts.samples);
  measures.shape = shapeOf(measures, middleOf(counts.changes));
  // A machine that rests stays at zero, which is no limit.
  const bool is_limit = (measures.at_smallest > kClipped && measures.smallest != 0) ||
                        (measures.at_largest > kClipped && measures.largest != 0);
  measures.clipped = measures.shape == SignalShape::continuous && is_limit;
  measures.band = bandHertz(channel);
  return measures;
}

}  // namespace uncertainty_identification
