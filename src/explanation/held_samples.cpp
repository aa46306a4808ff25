#include "explanation/held_samples.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace uncertainty_identification {
namespace {

/// Whether two samples are one reading, which is the newest at both points of the grid where the
/// stamps are irregular.
bool isSameReading(const Experiment& experiment, int t) {
  constexpr double kRounding = 1e-3;                        // of the sample time
  const Eigen::VectorXd& offset = experiment.stamp_offset;  // [s], of the stamp from the grid
  if (offset.size() == 0) return false;
  const double apart = offset[t] - offset[t - 1] + experiment.sample_time;
  return std::abs(apart) < kRounding * experiment.sample_time;
}

/// How often values strictly between the extremes occur again. A sensor of fine resolution repeats
/// values only while it holds them.
long repeats(const std::vector<double>& sorted) {
  long count = 0;
  for (std::size_t k = 1; k < sorted.size(); ++k)
    count += sorted[k] == sorted[k - 1] && sorted[k] > sorted.front() && sorted[k] < sorted.back();
  return count;
}

/// Whether readings after a value that was repeated make up for what was not read meanwhile, as
/// those of a sensor do that holds its last value. A machine that stands still, as friction or a
/// dead zone makes it, goes on from where it stood, with a first step about as large as the next;
/// one that reversed while nothing was read makes up for less than a steady motion would. Where a
/// reading says little about the next one, most of it is noise; that would be seen of a machine
/// that stands still, too, so that readings that repeat exactly are the sensor's. Where no reading
/// follows, nothing was made up for: the record was filled up.
bool catchesUp(const std::vector<Experiment>& experiments, double low, double high) {
  constexpr double kSmooth = 0.3;  // correlation of two steps of a reading that has little noise
  constexpr double kShare = 0.5;   // of what a steady motion would have made meanwhile
  double products = 0, squares = 0, made = 0, expected = 0, from_rest = 0;
  bool goes_on = false;
  for (const Experiment& experiment : experiments) {
    const Eigen::VectorXd& y = experiment.y;
    for (int t = 2; t + 1 < experiment.samples(); ++t) {
      const bool known = experiment.isValid(t - 2) && experiment.isValid(t - 1) &&
                         experiment.isValid(t) && experiment.isValid(t + 1);
      if (!known || isHeld(experiment, t, low, high)) continue;
      if (!isHeld(experiment, t - 1, low, high)) {
        products += (y[t] - y[t - 1]) * (y[t + 1] - y[t]);
        squares += (y[t] - y[t - 1]) * (y[t] - y[t - 1]);
        continue;
      }
      goes_on = true;
      int first = t - 1;  // the reading that was repeated
      while (isHeld(experiment, first, low, high)) --first;
      const double before = first > 0 ? std::abs(y[first] - y[first - 1]) : 0;
      made += std::abs(y[t] - y[t - 1]);
      expected += (t - first) * 0.5 * (before + std::abs(y[t + 1] - y[t]));
      from_rest += std::abs(y[t + 1] - y[t]);
    }
  }
  const double least = std::min(kShare * expected, std::sqrt(expected * from_rest));
  return goes_on && (products < kSmooth * squares || made >= least);
}

/// Whether the values that are repeated go up and down by few steps of one size, as those of a slow
/// signal in coarse resolution do, also where a filter puts other values in between. A sensor that
/// holds fine readings holds any values.
bool repeatsCoarseSteps(const std::vector<Experiment>& experiments, double low, double high) {
  constexpr double kFewSteps = 4, kMost = 0.9, kTolerance = 0.02;
  constexpr double kOften = 0.2;  // share of repeats, of which a sensor that holds has fewer
  double samples = 0, repeats = 0;
  std::vector<double> steps;
  for (const Experiment& experiment : experiments) {
    double last = std::numeric_limits<double>::quiet_NaN();
    for (int t = 1; t < experiment.samples(); ++t) {
      ++samples;
      if (!isHeld(experiment, t, low, high)) continue;
      ++repeats;
      if (experiment.y[t] != last && std::isfinite(last))
        steps.push_back(std::abs(experiment.y[t] - last));
      last = experiment.y[t];
    }
  }
  if (steps.size() < kFewestRepeats || repeats < kOften * samples) return false;
  std::sort(steps.begin(), steps.end());
  const double step = steps[steps.size() / 10];  // a few others are filtered, too
  const auto whole = std::count_if(steps.begin(), steps.end(), [step](double each) {
    return std::abs(each / step - std::round(each / step)) < kTolerance;
  });
  return steps[steps.size() / 2] <= kFewSteps * step &&
         static_cast<double>(whole) >= kMost * static_cast<double>(steps.size());
}

std::vector<HeldRow> rowsOf(const Experiment& experiment, const Readings& readings) {
  constexpr int kFewest = 3;
  std::vector<HeldRow> rows;
  int begin = 1;
  for (int t = 1; t <= experiment.samples(); ++t) {
    if (t < experiment.samples() && isHeld(experiment, t, readings.low, readings.high)) continue;
    if (t - begin >= kFewest) rows.push_back({begin, t});
    begin = t + 1;
  }
  return rows;
}

/// Whether the two readings before the row and after it are known.
bool isBetweenReadings(const Experiment& experiment, const HeldRow& row) {
  return row.begin >= 2 && row.end + 1 < experiment.samples() &&
         experiment.isValid(row.begin - 2) && experiment.isValid(row.end) &&
         experiment.isValid(row.end + 1);
}

bool isGap(const Experiment& experiment, const HeldRow& row, double resolution) {
  constexpr double kMoves = 2.5, kFar = 2, kAbout = 3;  // steps; ratios
  const Eigen::VectorXd &y = experiment.y, &u = experiment.u;
  const double before = std::abs(y[row.begin - 1] - y[row.begin - 2]);
  const double after = std::abs(y[row.end + 1] - y[row.end]);
  const double made = std::abs(y[row.end] - y[row.end - 1]);
  const double expected = (row.end - row.begin + 1) * 0.5 * (before + after);
  const int half = (row.end - row.begin + 1) / 2;
  const bool is_driven =
      u.segment(row.begin, half).cwiseNotEqual(u.segment(row.begin - 1, half)).any();
  return is_driven && std::min(before, after) > kMoves * resolution &&
         made >= kFar * std::max(before, after) && made <= kAbout * expected &&
         expected <= kAbout * made;
}

}  // namespace

bool isHeld(const Experiment& experiment, int t, double low, double high) {
  return t > 0 && !isSameReading(experiment, t) && experiment.isValid(t) &&
         experiment.isValid(t - 1) && experiment.y[t] == experiment.y[t - 1] &&
         experiment.y[t] > low && experiment.y[t] < high;
}

double heldShare(const std::vector<Experiment>& experiments, const std::vector<double>& sorted) {
  constexpr double kInARow = 0.9;  // share of the repeats that follow the sample they repeat
  long held = 0;
  for (const Experiment& experiment : experiments) {
    for (int t = 1; t < experiment.samples(); ++t)
      held += isHeld(experiment, t, sorted.front(), sorted.back());
  }
  if (held < kFewestRepeats ||
      static_cast<double>(held) < kInARow * static_cast<double>(repeats(sorted)) ||
      !catchesUp(experiments, sorted.front(), sorted.back()) ||
      repeatsCoarseSteps(experiments, sorted.front(), sorted.back()))
    return 0;
  return static_cast<double>(held) / static_cast<double>(sorted.size());
}

std::vector<HeldRow> gapsOf(const Experiment& experiment, const Readings& readings) {
  std::vector<HeldRow> gaps = rowsOf(experiment, readings);
  const auto is_none = [&](const HeldRow& row) {
    return !isBetweenReadings(experiment, row) || !isGap(experiment, row, readings.resolution);
  };
  gaps.erase(std::remove_if(gaps.begin(), gaps.end(), is_none), gaps.end());
  return gaps;
}

double shareInGaps(const std::vector<Experiment>& experiments, const Readings& readings) {
  constexpr double kMost = 0.5;
  double rows = 0, gaps = 0, held = 0, samples = 0;
  for (const Experiment& experiment : experiments) {
    samples += experiment.validSamples();
    for (const HeldRow& row : rowsOf(experiment, readings))
      rows += isBetweenReadings(experiment, row) ? 1 : 0;
    for (const HeldRow& gap : gapsOf(experiment, readings)) {
      ++gaps;
      held += gap.end - gap.begin;
    }
  }
  return gaps >= kFewestRepeats && gaps >= kMost * rows ? held / samples : 0;
}

}  // namespace uncertainty_identification
