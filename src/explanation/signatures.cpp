#include "signatures.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace uncertainty_identification {
namespace {

constexpr int kFewest = 4;  // exact repeats that do not happen by chance

std::vector<double> measured(const std::vector<Experiment>& experiments) {
  std::vector<double> values;
  for (const Experiment& experiment : experiments) {
    for (int t = 0; t < experiment.samples(); ++t)
      if (experiment.isValid(t)) values.push_back(experiment.y[t]);
  }
  std::sort(values.begin(), values.end());
  return values;
}

/// The step of a lattice that all values lie on; 0 where there is none.
double latticeStep(const std::vector<double>& values) {
  constexpr std::size_t kMostLevels = 4000;
  constexpr double kTolerance = 1e-3;
  std::vector<double> levels;
  const double span = values.back() - values.front();
  for (const double value : values) {
    if (levels.empty() || value - levels.back() > 1e-9 * span) levels.push_back(value);
  }
  if (levels.size() < 2 || 2 * levels.size() > values.size() || levels.size() > kMostLevels)
    return 0;
  double step = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < levels.size(); ++k) step = std::min(step, levels[k] - levels[k - 1]);
  for (std::size_t k = 1; k < levels.size(); ++k) {
    const double steps = (levels[k] - levels[k - 1]) / step;
    if (std::abs(steps - std::round(steps)) > kTolerance) return 0;
  }
  return step;
}

CauseParameter exact(const std::string& name, const std::string& unit, double value) {
  return {name, unit, value, 0, value, value};
}

/// Whether sample t is within the extremes and repeats the one before.
bool isHeld(const Experiment& experiment, int t, double low, double high) {
  return t > 0 && experiment.isValid(t) && experiment.isValid(t - 1) &&
         experiment.y[t] == experiment.y[t - 1] && experiment.y[t] > low && experiment.y[t] < high;
}

/// How often a value within the extremes occurs again: of a sensor that resolves finely, when held.
long repeats(const std::vector<double>& sorted) {
  long count = 0;
  for (std::size_t k = 1; k < sorted.size(); ++k)
    count += sorted[k] == sorted[k - 1] && sorted[k] > sorted.front() && sorted[k] < sorted.back();
  return count;
}

}  // namespace

std::vector<Experiment> withoutRest(std::vector<Experiment> experiments) {
  for (Experiment& experiment : experiments) {
    int moves = 1;
    while (moves < experiment.samples() && experiment.y[moves] == experiment.y[0]) ++moves;
    if (moves < kFewest || moves == experiment.samples()) continue;
    experiment.valid.resize(static_cast<std::size_t>(experiment.samples()), 1);
    std::fill_n(experiment.valid.begin(), moves, 0);
  }
  return experiments;
}

std::vector<Signature> signaturesOf(const std::vector<Experiment>& experiments) {
  const std::vector<double> values = measured(experiments);
  if (values.size() < 2) return {};
  if (const double step = latticeStep(values); step > 0)
    return {{"sens_quant", {exact("step", "unit of y", step)}}};
  const double low = values.front(), high = values.back();
  const auto low_count = std::upper_bound(values.begin(), values.end(), low) - values.begin();
  const auto high_count = values.end() - std::lower_bound(values.begin(), values.end(), high);
  std::vector<Signature> found;
  if (std::max(low_count, high_count) >= kFewest)
    found.push_back(
        {"sens_clip",
         {exact("lower_limit", "unit of y",
                low_count >= kFewest ? low : -std::numeric_limits<double>::infinity()),
          exact("upper_limit", "unit of y",
                high_count >= kFewest ? high : std::numeric_limits<double>::infinity())}});
  long held = 0;
  for (const Experiment& experiment : experiments) {
    for (int t = 1; t < experiment.samples(); ++t) held += isHeld(experiment, t, low, high);
  }
  if (held >= kFewest && 2 * held > repeats(values))
    found.push_back(
        {"sens_dropout",
         {exact("share", "1", static_cast<double>(held) / static_cast<double>(values.size()))}});
  return found;
}

std::vector<Experiment> withoutSpoiled(std::vector<Experiment> experiments,
                                       const Signature& signature) {
  if (signature.name == "sens_quant") return experiments;
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const bool clipped = signature.name == "sens_clip";
  const double low = clipped ? signature.parameters[0].value : -kFar;
  const double high = clipped ? signature.parameters[1].value : kFar;
  for (Experiment& experiment : experiments) {
    std::vector<std::uint8_t> valid(static_cast<std::size_t>(experiment.samples()));
    for (int t = 0; t < experiment.samples(); ++t) {
      const bool spoiled = clipped ? experiment.y[t] <= low || experiment.y[t] >= high
                                   : isHeld(experiment, t, low, high);
      valid[static_cast<std::size_t>(t)] = experiment.isValid(t) && !spoiled;
    }
    experiment.valid = std::move(valid);
  }
  return experiments;
}

}  // namespace uncertainty_identification
