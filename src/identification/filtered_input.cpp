#include <algorithm>
#include <limits>

#include "identification/error_structures.h"
#include "identification/structure_fit.h"

/// Plants that differ by filters of the input whose mean is not 1: Go is then smaller than the mean
/// of the plants, which is what a common simulation or a zero mean of the errors shows.
namespace uncertainty_identification {
namespace {

ErrorStructure filtersOf(const Problem& problem, int delay, int nb, int na, int taps) {
  ErrorStructure filters{"fir, " + std::to_string(taps) +
                             " taps, zero_static_gain (nb=" + std::to_string(nb) +
                             " na=" + std::to_string(na) + " delay=" + std::to_string(delay) + ")",
                         problem.configuration};
  NominalModelOptions& nominal = filters.configuration.nominal_model;
  nominal.delay = delay;
  nominal.nb = nb;
  nominal.na = na;
  ErrorModelOptions& errors = filters.configuration.error_model;
  errors.basis = BasisKind::fir;
  errors.constraint = Constraint::zero_static_gain;
  errors.taps = taps;
  return filters;
}

/// Whether dead times differ: a filter of several taps looks like another dead time.
bool variesDeadTime(const ErrorModelOptions& options) {
  const auto& varied = options.parameters;
  return options.basis == BasisKind::parameter_spread &&
         std::find(varied.begin(), varied.end(), "dead_time") != varied.end();
}

}  // namespace

bool mayBeFilters(const Problem& problem, const std::vector<StructureFit>& fits,
                  const StructureFit& chosen) {
  constexpr double kAbout = 5;  // [nats] per experiment, for what a free mean may gain
  constexpr int kFewest = 8;    // experiments, for a mean in several directions
  if (problem.data.count() < kFewest) return false;
  const double least = scoreOf(problem, chosen) - kAbout * problem.data.count();
  const auto are_filters = [&](const StructureFit& fit) {
    const ErrorModelOptions& options = fit.structure.configuration.error_model;
    const bool filters = options.basis == BasisKind::fir && options.taps > 1;
    return (filters || isSpreadOfNumerator(options)) && scoreOf(problem, fit) > least;
  };
  return are_filters(chosen) || variesDeadTime(chosen.structure.configuration.error_model) ||
         std::any_of(fits.begin(), fits.end(), are_filters);
}

std::optional<StructureFit> fitFilters(const Problem& problem, Journal* journal) {
  constexpr int kFewestTaps = 2;
  const int shown = std::min(problem.configuration.error_model.max_taps, problem.data.count() / 2);
  const int most_taps = std::max(kFewestTaps, shown);
  const int largest = problem.configuration.nominal_model.max_order;
  std::optional<StructureFit> best;
  double score = -std::numeric_limits<double>::infinity();  // the highest, of this delay
  const auto improves = [&](int delay, int nb, int na, int taps) {
    if (best && journal->progress.searchEnds()) return false;
    auto fit = fitStructure(problem, filtersOf(problem, delay, nb, na, taps), {}, true, journal);
    const double its = fit ? scoreOf(problem, *fit) : score;
    if (!(its > score)) return false;
    score = its;
    if (!best || its > scoreOf(problem, *best)) best = std::move(fit);
    return true;
  };
  const auto improvesAt = [&](int delay, int order) {
    bool any = false;
    for (int taps = most_taps; taps >= kFewestTaps; --taps)
      any = improves(delay, order, order, taps) || any;
    return any;
  };
  const int found_delay = problem.configuration.nominal_model.delay;
  const int latest = std::max(found_delay, 1);
  // Filters whose first taps are small look like a longer delay.
  const int earliest = std::max(latest - most_taps + 1, std::min(found_delay, 1));
  for (int delay = latest; delay >= earliest; --delay) {
    score = -std::numeric_limits<double>::infinity();
    for (int order = 1; order <= largest && improvesAt(delay, order); ++order) continue;
  }
  if (!best) return best;
  score = scoreOf(problem, *best);
  const NominalModelOptions found = best->structure.configuration.nominal_model;
  const int taps = best->structure.configuration.error_model.taps;
  for (int nb = found.nb; nb > 1 && improves(found.delay, nb - 1, found.na, taps);) --nb;
  return best;
}

}  // namespace uncertainty_identification
