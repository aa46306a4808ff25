#include "data/sample_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "math/constants.h"
#include "math/median.h"

namespace uncertainty_identification {
namespace {

std::vector<double> spacings(const std::vector<double>& stamps) {
  std::vector<double> spacing(stamps.size() - 1);
  for (std::size_t i = 0; i < spacing.size(); ++i) spacing[i] = stamps[i + 1] - stamps[i];
  return spacing;
}

/// Mean of those spacings that are near the median. No sample is lost within them, and their jitter
/// averages out.
double meanStep(const std::vector<double>& spacing, double middle) {
  double sum = 0;
  long count = 0;
  for (const double each : spacing) {
    if (each < 0.5 * middle || each > 1.5 * middle) continue;
    sum += each;
    ++count;
  }
  return sum / static_cast<double>(count);
}

/// The line stamp = origin + slot * period.
struct Line {
  double origin = 0, period = 0;  // [s]
};

/// Least-squares line through the first `count` stamps as a function of their slots.
Line fitLine(const std::vector<double>& stamps, const std::vector<long>& slots, std::size_t count) {
  const auto number = static_cast<double>(count);
  double mean_slot = 0, mean_stamp = 0;
  for (std::size_t i = 0; i < count; ++i) {
    mean_slot += static_cast<double>(slots[i]) / number;
    mean_stamp += (stamps[i] - stamps.front()) / number;
  }
  double cross = 0, square = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double slot = static_cast<double>(slots[i]) - mean_slot;
    cross += slot * (stamps[i] - stamps.front() - mean_stamp);
    square += slot * slot;
  }
  const double period = square > 0 ? cross / square : 0;
  return {stamps.front() + mean_stamp - period * mean_slot, period};
}

/// The line with the given period whose phase is the circular mean of the phases of the first
/// `count` stamps.
Line phaseLine(const std::vector<double>& stamps, double period, std::size_t count) {
  double sine = 0, cosine = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * kPi * std::fmod((stamps[i] - stamps.front()) / period, 1.0);
    sine += std::sin(angle);
    cosine += std::cos(angle);
  }
  return {stamps.front() + std::atan2(sine, cosine) / (2 * kPi) * period, period};
}

/// The slot on the line nearest to each of the first `count` stamps.
void setNearestSlots(const std::vector<double>& stamps, const Line& line, std::size_t count,
                     std::vector<long>& slots) {
  constexpr double kMost = 1e15;  // keeps the slots of absurd stamps within the range of long
  for (std::size_t i = 0; i < count; ++i) {
    slots[i] = std::lround(std::min(kMost, (stamps[i] - line.origin) / line.period));
  }
}

/// Finds the slots of stamps whose period is known roughly. A line through the first few stamps
/// gives the slots of twice as many, a line through those the slots of twice as many again, and so
/// on: no line is extrapolated further than it is accurate.
std::vector<long> findSlots(const std::vector<double>& stamps, double period) {
  constexpr std::size_t kFirstBlock = 16;
  std::vector<long> slots(stamps.size(), 0);
  std::size_t count = std::min(kFirstBlock, stamps.size());
  Line line = phaseLine(stamps, period, count);
  for (;; count = std::min(2 * count, stamps.size())) {
    for (int pass = 0; pass < 2; ++pass) {
      setNearestSlots(stamps, line, count, slots);
      const Line fitted = fitLine(stamps, slots, count);
      if (fitted.period > 0.5 * period) line = fitted;
    }
    if (count == stamps.size()) break;
  }
  setNearestSlots(stamps, line, count, slots);
  for (std::size_t i = slots.size(); i-- > 0;) slots[i] -= slots[0];
  return slots;
}

/// Whether the stamps are those of a uniform clock, printed with a resolution that is little finer
/// than its period: a period of 1.2 ms in whole ms gives steps of 1 and 2 ms. Rows that are lost at
/// random leave such steps too, but do not stay within the rounding of one line. Those that are
/// lost regularly do; they are few, and seldom those of a period of one unit.
bool areCoarselyRounded(const std::vector<double>& stamps, const std::vector<double>& spacing) {
  constexpr double kFewest = 8;    // double steps; so many, lost at random, leave the line
  constexpr double kShare = 0.04;  // double steps
  constexpr double kSame = 0.01, kRounding = 0.75;  // [resolutions]
  const double resolution = *std::min_element(spacing.begin(), spacing.end());
  const double unit = std::pow(10.0, std::round(std::log10(resolution)));  // as it is printed
  if (!(std::abs(resolution - unit) <= kSame * unit)) return false;
  const auto isStep = [&](double step, double multiple) {
    return std::abs(step - multiple * resolution) <= kSame * resolution;
  };
  const auto isEither = [&](double step) { return isStep(step, 1) || isStep(step, 2); };
  const auto isDouble = [&](double step) { return isStep(step, 2); };
  const auto steps = static_cast<double>(spacing.size());
  const auto doubles = static_cast<double>(std::count_if(spacing.begin(), spacing.end(), isDouble));
  if (doubles < std::max(kFewest, kShare * steps) ||
      !std::all_of(spacing.begin(), spacing.end(), isEither))
    return false;
  std::vector<long> counted(stamps.size());
  std::iota(counted.begin(), counted.end(), 0L);
  const Line line = fitLine(stamps, counted, stamps.size());
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    const double expected = line.origin + static_cast<double>(i) * line.period;
    if (std::abs(stamps[i] - expected) > kRounding * resolution) return false;
  }
  return true;
}

/// The decimal number with the fewest digits that differs from a positive value by at most
/// `halfwidth`; the value itself if there is none.
double simplestDecimal(double value, double halfwidth) {
  const int exponent = static_cast<int>(std::floor(std::log10(value)));
  for (int digits = 1; digits <= 17; ++digits) {
    const int power = digits - 1 - exponent;
    const double scale = std::pow(10.0, std::abs(power));
    const double candidate =
        power >= 0 ? std::round(value * scale) / scale : std::round(value / scale) * scale;
    if (candidate > 0 && std::abs(candidate - value) <= halfwidth) return candidate;
  }
  return value;
}

/// Whether every stamp equals first + slot * period to the last bit, as when a program computed it.
bool reproduces(const std::vector<double>& stamps, const std::vector<long>& slots, double period) {
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    if (stamps[i] != stamps.front() + static_cast<double>(slots[i]) * period) return false;
  }
  return true;
}

/// Sets the origin and the departures, given the period and the slots.
void measureDepartures(const std::vector<double>& stamps, SampleGrid& grid) {
  std::vector<double> departures(stamps.size());
  double largest = 0;
  for (std::size_t i = 0; i < stamps.size(); ++i) {
    departures[i] = stamps[i] - stamps.front() - static_cast<double>(grid.slots[i]) * grid.period;
    largest = std::max(largest, std::abs(departures[i]));
  }
  const double scale = std::max(std::abs(stamps.front()), std::abs(stamps.back()));
  const bool exact = largest <= stampTolerance(scale, grid.period);
  const double phase = exact ? 0 : medianOf(departures);
  grid.origin = stamps.front() + phase;
  grid.max_departure = 0;
  for (double& departure : departures) {
    departure = std::abs(departure - phase);
    grid.max_departure = std::max(grid.max_departure, departure);
  }
  grid.typical_departure = medianOf(std::move(departures));
}

/// [s] the largest error of the period that moves no slot by more than the jitter, or, without
/// jitter, by more than the rounding error.
double periodUncertainty(const std::vector<double>& stamps, const SampleGrid& grid) {
  constexpr double kRounding = 1e-14;  // relative rounding error of the line through the stamps
  const double resolution = std::abs(stamps.back()) * std::numeric_limits<double>::epsilon();
  const double jitter = std::max(grid.max_departure, resolution);
  return std::max(jitter / static_cast<double>(grid.slots.back()), kRounding * grid.period);
}

/// Whether nearly all spacings are the median, so that a few odd ones, and no jitter, move the line
/// through the stamps.
bool isStepped(const std::vector<double>& spacing, double middle, const SampleGrid& grid) {
  constexpr double kSame = 1e-3, kNearlyAll = 0.9, kFar = 0.25;
  const auto same = std::count_if(spacing.begin(), spacing.end(), [&](double each) {
    return std::abs(each - middle) <= kSame * middle;
  });
  return static_cast<double>(same) >= kNearlyAll * static_cast<double>(spacing.size()) &&
         grid.max_departure > kFar * grid.period;
}

bool allDistinct(const std::vector<long>& slots) {
  return std::adjacent_find(slots.begin(), slots.end()) == slots.end();
}

}  // namespace

double stampTolerance(double stamp, double sample_time) {
  const double resolution = std::abs(stamp) * std::numeric_limits<double>::epsilon();
  return std::max(1e-6 * sample_time, 4 * resolution);
}

SampleGrid fitSampleGrid(const std::vector<double>& stamps) {
  SampleGrid grid;
  grid.slots.assign(stamps.size(), 0);
  if (!stamps.empty()) grid.origin = stamps.front();
  if (stamps.size() < 2) return grid;
  const std::vector<double> spacing = spacings(stamps);
  const double middle = medianOf(spacing);
  const bool counted = areCoarselyRounded(stamps, spacing);
  if (counted)
    std::iota(grid.slots.begin(), grid.slots.end(), 0L);
  else
    grid.slots = findSlots(stamps, meanStep(spacing, middle));
  const double fitted = fitLine(stamps, grid.slots, stamps.size()).period;
  grid.period = fitted > 0 ? fitted : middle;
  measureDepartures(stamps, grid);
  const auto followsGrid = [&] { return counted || grid.max_departure < 0.5 * grid.period; };
  grid.one_to_one =
      allDistinct(grid.slots) && followsGrid() && (counted || !isStepped(spacing, middle, grid));
  if (!grid.one_to_one) {
    grid.period = middle;
    return grid;
  }
  const double first_step = (stamps[1] - stamps[0]) / static_cast<double>(grid.slots[1]);
  grid.period = reproduces(stamps, grid.slots, first_step)
                    ? first_step
                    : simplestDecimal(grid.period, periodUncertainty(stamps, grid));
  measureDepartures(stamps, grid);
  grid.one_to_one = followsGrid();
  return grid;
}

}  // namespace uncertainty_identification
