#include <algorithm>
#include <limits>

#include "estimation/excerpt.h"
#include "estimation/first_samples.h"
#include "identification/steps.h"
#include "identification/structure_fit.h"

/// Whether each experiment has an operating point of its own.
namespace uncertainty_identification {
namespace {

/// A model whose gain varies and whose noise is coloured.
Configuration simpleModel(Configuration simple) {
  NominalModelOptions nominal;
  nominal.structure = Structure::box_jenkins;
  nominal.fit = PlantFit::likelihood;
  nominal.nc = nominal.nd = 1;
  nominal.max_delay = simple.nominal_model.max_delay;
  nominal.orders_auto = false;
  simple.nominal_model = nominal;
  ErrorModelOptions& errors = simple.error_model;
  errors.basis = BasisKind::fir;
  errors.constraint = Constraint::zero_mean;
  errors.taps = 1;
  simple.effects.clear();
  return simple;
}

/// Half BIC of the better of two orders, by what follows the first samples, which determine an
/// offset. One order alone would not do: a pole too many integrates, and its state is an offset.
double densityWith(Offsets offsets, Problem problem, Journal* journal) {
  problem.configuration.estimation.offsets = offsets;
  NominalModelOptions& nominal = problem.configuration.nominal_model;
  double highest = -std::numeric_limits<double>::infinity();
  for (const int order : {1, 2}) {
    nominal.nb = nominal.na = order;
    nominal.delay = scannedDelay(problem, order);
    const auto fit = fitStructure(problem, {"gain", problem.configuration}, {}, true, journal);
    if (!fit) continue;
    double score = fit->score(static_cast<double>(problem.data.validSamples()), problem.data.count());
    if (!hasUnknownsOfExperiments(problem.configuration.estimation))
      score -= firstSamplesDensity(*fit->model, fit->point, problem.data.experiments,
                                   threadsOf(problem.configuration.estimation), &journal->passes);
    highest = std::max(highest, score);
  }
  return highest;
}

}  // namespace

Configuration chooseOffsets(const Problem& problem, Journal* journal) {
  constexpr int kFewest = 3;
  constexpr double kWorthIt = 3;  // [nats]
  Configuration chosen = problem.configuration;
  Offsets& offsets = chosen.estimation.offsets;
  if (offsets != Offsets::automatic) return chosen;
  offsets = Offsets::estimate;
  const bool at_input = chosen.estimation.offset_side == OffsetSide::input;
  if (problem.data.count() < kFewest || at_input || hasGivenParameters(problem)) return chosen;
  CheckedData data;
  data.experiments = thinned(problem.data.experiments, kEnoughSamples);
  data.blocks = makeBlocks(data.experiments);
  const Problem simple{data, {}, nullptr, simpleModel(problem.configuration), {}, {}};
  const double common = densityWith(Offsets::estimate, simple, journal);
  const double own = densityWith(Offsets::per_experiment, simple, journal);
  const bool differ = own > common + kWorthIt;
  if (differ) offsets = Offsets::per_experiment;
  journal->candidates.push_back({"offsets", "common", 0, {}, -2 * common, {}, !differ, {}});
  journal->candidates.push_back({"offsets", "of each experiment", 0, {}, -2 * own, {}, differ, {}});
  return chosen;
}

}  // namespace uncertainty_identification
