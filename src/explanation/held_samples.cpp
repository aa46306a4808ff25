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
/// dead zone makes it, goes on from where it stood. Where a reading says little about the next one,
/// most of it is noise; that would be seen of a machine that stands still, too, so that readings
/// that repeat exactly are the sensor's. Where no reading follows, nothing was made up for: the
/// record was filled up.
bool catchesUp(const std::vector<Experiment>& experiments, double low, double high) {
  constexpr double kSmooth = 0.3;  // correlation of two steps of a reading that has little noise
  constexpr double kShare = 0.5;   // of what a steady motion would have made meanwhile
  double products = 0, squares = 0, made = 0, expected = 0;
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
    }
  }
  return goes_on && (products < kSmooth * squares || made >= kShare * expected);
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

/// Whether a row of repeats, from `first` to the sample before `next`, is a gap: what was missed is
/// made up for in one step, by about as much as the steps before and after say, and by far more
/// than either of them.
bool isGap(const Eigen::VectorXd& y, int first, int next) {
  constexpr double kFar = 2, kAbout = 3;
  const double before = std::abs(y[first] - y[first - 1]), after = std::abs(y[next + 1] - y[next]);
  const double made = std::abs(y[next] - y[next - 1]);
  const double expected = (next - first) * 0.5 * (before + after);
  return before > 0 && after > 0 && made >= kFar * std::max(before, after) &&
         made <= kAbout * expected && expected <= kAbout * made;
}

}  // namespace

bool isHeld(const Experiment& experiment, int t, double low, double high, int in_a_row) {
  const auto repeats = [&](int at) {
    return at > 0 && at < experiment.samples() && !isSameReading(experiment, at) &&
           experiment.isValid(at) && experiment.isValid(at - 1) &&
           experiment.y[at] == experiment.y[at - 1] && experiment.y[at] > low &&
           experiment.y[at] < high;
  };
  if (!repeats(t)) return false;
  int count = 1;
  for (int at = t - 1; count < in_a_row && repeats(at); --at) ++count;
  for (int at = t + 1; count < in_a_row && repeats(at); ++at) ++count;
  return count >= in_a_row;
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

double shareInGaps(const std::vector<Experiment>& experiments, double low, double high) {
  constexpr double kMost = 0.5;
  int rows = 0, gaps = 0;
  double held = 0, samples = 0;
  for (const Experiment& experiment : experiments) {
    samples += static_cast<double>(experiment.validSamples());
    for (int t = 1; t + 1 < experiment.samples(); ++t) {
      if (!isHeld(experiment, t - 1, low, high, kOfAGap)) continue;
      ++held;
      if (isHeld(experiment, t, low, high, kOfAGap)) continue;
      int first = t - 1;
      while (isHeld(experiment, first, low, high, kOfAGap)) --first;
      ++rows;
      gaps += first > 0 && isGap(experiment.y, first, t);
    }
  }
  return gaps >= kFewestRepeats && gaps >= kMost * rows ? held / samples : 0;
}

}  // namespace uncertainty_identification
