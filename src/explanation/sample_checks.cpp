#include "explanation/sample_checks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "data/unmeasured_start.h"
#include "explanation/held_samples.h"

namespace uncertainty_identification {
namespace {

constexpr double kCrowded = 3;  // times as many samples at a limit as at the values next to it

std::vector<double> measured(const std::vector<Experiment>& experiments) {
  std::vector<double> values;
  for (const Experiment& experiment : experiments) {
    for (int t = 0; t < experiment.samples(); ++t)
      if (experiment.isValid(t)) values.push_back(experiment.y[t]);
  }
  std::sort(values.begin(), values.end());
  return values;
}

/// The smallest difference between two values that differ by more than rounding.
double smallestDifference(const std::vector<double>& sorted) {
  const double rounding = 1e-9 * (sorted.back() - sorted.front());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < sorted.size(); ++k)
    if (sorted[k] - sorted[k - 1] > rounding) least = std::min(least, sorted[k] - sorted[k - 1]);
  return least;
}

/// The power of ten of which all values are multiples, as a file prints them; 0 where there is
/// none.
double printedUnit(const std::vector<double>& values) {
  constexpr int kMostDigits = 7;
  constexpr double kWhole = 1e-6;
  double unit = 1;
  for (int digits = 0; digits <= kMostDigits; ++digits, unit /= 10) {
    const bool all = std::all_of(values.begin(), values.end(), [unit](double value) {
      return std::abs(value / unit - std::round(value / unit)) < kWhole;
    });
    if (all) return unit;
  }
  return 0;
}

/// The quantisation step, of which all differences between the values are multiples, but for the
/// rounding with which they are printed: steps of 1/16 may read 27.50, 27.56, 27.62. 0 where there
/// is none.
double latticeStep(const std::vector<double>& values) {
  constexpr std::size_t kMostLevels = 4000;
  constexpr double kTolerance = 1e-3, kFine = 0.25;  // of a step
  std::vector<double> levels;
  const double span = values.back() - values.front();
  for (const double value : values) {
    if (levels.empty() || value - levels.back() > 1e-9 * span) levels.push_back(value);
  }
  if (levels.size() < 2 || 2 * levels.size() > values.size() || levels.size() > kMostLevels)
    return 0;
  const double least = smallestDifference(levels);
  double steps = 0;
  for (std::size_t k = 1; k < levels.size(); ++k)
    steps += std::round((levels[k] - levels[k - 1]) / least);
  const double step = (levels.back() - levels.front()) / steps, unit = printedUnit(values);
  const double rounding = unit <= kFine * step ? 1.01 * unit : 0;
  for (std::size_t k = 1; k < levels.size(); ++k) {
    const double difference = levels[k] - levels[k - 1];
    if (std::abs(difference - std::round(difference / step) * step) >
        std::max(kTolerance * step, rounding))
      return 0;
  }
  return step;
}

/// Number of samples at a value that was reached and left again: a record that begins or ends there
/// may show a machine at rest. If the sensor `holds` samples, those that repeat the sample before
/// are not counted.
long visits(const std::vector<Experiment>& experiments, double value, bool holds) {
  long count = 0;
  for (const Experiment& experiment : experiments) {
    int first = 0, last = experiment.samples();
    while (first < last && experiment.y[first] == value) ++first;
    while (last > first && experiment.y[last - 1] == value) --last;
    for (int t = first; t < last; ++t) {
      const bool there = experiment.isValid(t) && experiment.y[t] == value;
      const bool stays =
          there && t > 0 && experiment.isValid(t - 1) && experiment.y[t - 1] == value;
      count += there && !(holds && stays);
    }
  }
  return count;
}

/// Standard deviation of all inputs.
double inputDeviation(const std::vector<Experiment>& experiments) {
  double sum = 0, squares = 0, samples = 0;
  for (const Experiment& experiment : experiments) {
    sum += experiment.u.sum();
    squares += experiment.u.squaredNorm();
    samples += experiment.samples();
  }
  return std::sqrt(std::max(squares / samples - sum * sum / samples / samples, 0.0));
}

/// Whether inputs that differ widely lead to the same value. Where a machine turns round or rests
/// at its largest output, held there by friction, its input hardly moves.
bool isReachedByDifferentInputs(const std::vector<Experiment>& experiments, double value) {
  constexpr double kWidely = 0.3;  // standard deviations of the input
  std::vector<double> there;
  for (const Experiment& experiment : experiments) {
    for (int t = 0; t < experiment.samples(); ++t)
      if (experiment.isValid(t) && experiment.y[t] == value) there.push_back(experiment.u[t]);
  }
  std::sort(there.begin(), there.end());
  const std::size_t tenth = there.size() / 10;
  return there[there.size() - 1 - tenth] - there[tenth] > kWidely * inputDeviation(experiments);
}

/// Whether readings between the extremes hardly ever repeat, but go up and down, while the input
/// stands still: the sensor shows its noise, so that a machine at rest would not repeat a value.
bool showsNoiseAtRest(const std::vector<Experiment>& experiments, double low, double high) {
  constexpr double kFewest = 100, kHardlyEver = 0.01, kUpAndDown = 0.3;  // samples; shares
  double still = 0, repeats = 0, turns = 0;
  for (const Experiment& experiment : experiments) {
    const Eigen::VectorXd &y = experiment.y, &u = experiment.u;
    const auto is_between = [&](int t) {
      return experiment.isValid(t) && y[t] > low && y[t] < high;
    };
    for (int t = 2; t < experiment.samples(); ++t) {
      const bool rests = u[t] == u[t - 1] && u[t - 1] == u[t - 2];
      if (!rests || !is_between(t) || !is_between(t - 1) || !is_between(t - 2)) continue;
      ++still;
      repeats += y[t] == y[t - 1] ? 1 : 0;
      turns += (y[t] - y[t - 1]) * (y[t - 1] - y[t - 2]) < 0 ? 1 : 0;
    }
  }
  return still >= kFewest && repeats < kHardlyEver * still && turns > kUpAndDown * still;
}

/// Whether readings between the extremes stand still about as long as at this one, while the input
/// moves: then they are held, or interpolated, wherever they are.
bool standsStillElsewhere(const std::vector<Experiment>& experiments, double value, double low,
                          double high) {
  constexpr double kMoves = 0.1;  // standard deviations of the input
  const double moves = kMoves * inputDeviation(experiments);
  int there = 0, elsewhere = 0;
  for (const Experiment& experiment : experiments) {
    for (int first = 0, next = 0; first < experiment.samples(); first = next) {
      const double reading = experiment.y[first];
      const bool known = experiment.isValid(first);
      do ++next;
      while (known && next < experiment.samples() && experiment.isValid(next) &&
             experiment.y[next] == reading);
      if (!known) continue;
      const auto inputs = experiment.u.segment(first, next - first);
      if (reading == value) there = std::max(there, next - first);
      const bool moving = inputs.maxCoeff() - inputs.minCoeff() > moves;
      if (reading > low && reading < high && moving) elsewhere = std::max(elsewhere, next - first);
    }
  }
  return elsewhere >= kFewestRepeats && 2 * elsewhere > there;
}

/// Whether the output comes to a value, and leaves it, at a speed that its readings show: by more
/// than a few of their smallest differences a sample. Readings of coarse resolution repeat their
/// largest value also where the machine turns round, but the last steps there are small.
bool isReachedAtSpeed(const std::vector<Experiment>& experiments, double value, double resolution) {
  constexpr double kFew = 2.5;
  std::vector<double> steps;
  for (const Experiment& experiment : experiments) {
    const Eigen::VectorXd& y = experiment.y;
    const auto known = [&](int t) {
      return t >= 0 && t < experiment.samples() && experiment.isValid(t);
    };
    for (int t = 0; t < experiment.samples(); ++t) {
      if (!known(t) || y[t] != value) continue;
      if (known(t - 1) && known(t - 2) && y[t - 1] != value)
        steps.push_back(std::abs(y[t - 1] - y[t - 2]));
      if (known(t + 1) && known(t + 2) && y[t + 1] != value)
        steps.push_back(std::abs(y[t + 1] - y[t + 2]));
    }
  }
  if (steps.empty()) return true;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>((steps.size() - 1) / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle > kFew * resolution;
}

/// How often the values next to the first one occur, in the median of five. Coarse resolution
/// repeats values everywhere, a limit only its own.
template <typename Iterator>
double visitsNextTo(Iterator first, Iterator end) {
  std::vector<double> counts;
  for (Iterator at = first; at != end && counts.size() < 6;) {
    const Iterator next = std::find_if(at, end, [&](double value) { return value != *at; });
    counts.push_back(static_cast<double>(next - at));
    at = next;
  }
  if (counts.size() < 2) return 0;
  std::sort(counts.begin() + 1, counts.end());
  return counts[1 + (counts.size() - 1) / 2];
}

}  // namespace

CauseParameter exactly(const std::string& name, const std::string& unit, double value) {
  return {name, unit, value, 0, value, value};
}

std::vector<Experiment> withoutRest(std::vector<Experiment> experiments) {
  constexpr int kKept = kFewestRepeats - 1;  // samples that show where the system rested
  for (Experiment& experiment : experiments) {
    const Eigen::VectorXd &u = experiment.u, &y = experiment.y;
    int moves = 1;
    while (moves < experiment.samples() && y[moves] == y[0] && u[moves] == u[0]) ++moves;
    if (moves > kKept && moves < experiment.samples())
      experiment = withoutFirst(moves - kKept, std::move(experiment));
  }
  return experiments;
}

std::vector<SpoiltSamples> checkSamples(const std::vector<Experiment>& experiments) {
  const std::vector<double> values = measured(experiments);
  if (values.size() < 2) return {};
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const double low = values.front(), high = values.back();
  const double resolution = smallestDifference(values);
  const double in_gaps = shareInGaps(experiments, {low, high, resolution});
  const SpoiltSamples gaps{Trait::held_samples, {exactly("share", "1", in_gaps)}, resolution};
  std::vector<SpoiltSamples> found;
  if (const double step = latticeStep(values); step > 0) {
    found.push_back({Trait::quantisation, {exactly("step", "unit of y", step)}});
    if (in_gaps > 0) found.push_back(gaps);
    return found;
  }
  const double held = heldShare(experiments, values);
  const bool noisy = showsNoiseAtRest(experiments, low, high);
  const auto isLimit = [&](double value, double next_to_it) {
    const auto count = static_cast<double>(visits(experiments, value, held > 0));
    return count >= kFewestRepeats && count >= kCrowded * next_to_it &&
           (noisy || isReachedByDifferentInputs(experiments, value)) &&
           !standsStillElsewhere(experiments, value, low, high) &&
           isReachedAtSpeed(experiments, value, resolution);
  };
  const bool at_low = isLimit(low, visitsNextTo(values.begin(), values.end()));
  const bool at_high = isLimit(high, visitsNextTo(values.rbegin(), values.rend()));
  if (at_low || at_high)
    found.push_back({Trait::output_limit,
                     {exactly("lower_limit", "unit of y", at_low ? low : -kNone),
                      exactly("upper_limit", "unit of y", at_high ? high : kNone)}});
  if (held > 0)
    found.push_back({Trait::held_samples, {exactly("share", "1", held)}});
  else if (in_gaps > 0)
    found.push_back(gaps);
  return found;
}

}  // namespace uncertainty_identification
