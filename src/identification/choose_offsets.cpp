#include <algorithm>
#include <limits>

#include "estimation/excerpt.h"
#include "identification/steps.h"
#include "identification/structure_fit.h"

/// Whether each experiment has an operating point of its own.
namespace uncertainty_identification {
namespace {

constexpr int kFewest = 3;  // experiments that show whether their offsets differ

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

/// Half BIC of the best of two orders with gains that vary, and one with time constants that do,
/// too; by what follows the first samples, which determine an offset. One order alone would not do:
/// a pole too many integrates, and its state is an offset.
double densityWith(Offsets offsets, Problem problem, Journal* journal) {
  problem.configuration.estimation.offsets = offsets;
  NominalModelOptions& nominal = problem.configuration.nominal_model;
  double highest = -std::numeric_limits<double>::infinity();
  for (const int order : {1, 2}) {
    if (journal->progress.cancelled()) break;
    nominal.nb = nominal.na = order;
    nominal.delay = scannedDelay(problem, order);
    auto fit = fitStructure(problem, {"gain", problem.configuration}, {}, true, journal);
    if (!fit) continue;
    fit = withBetterDelay(problem, std::move(*fit), journal);
    highest = std::max(highest, scoreAfterFirstSamples(problem, *fit, journal));
    if (order > 1 || journal->progress.cancelled()) continue;
    const StartingPoint start = fit->start();
    nominal.delay = start.polynomials.delay;
    for (const ErrorStructure& structure : variedStructures(problem, &start.polynomials)) {
      if (structure.configuration.error_model.parameters.size() != 2) continue;
      const auto varied = fitStructure(problem, structure, {start}, false, journal);
      if (varied) highest = std::max(highest, scoreAfterFirstSamples(problem, *varied, journal));
    }
  }
  return highest;
}

}  // namespace

Configuration chooseOffsets(const Problem& problem, Journal* journal) {
  constexpr double kWorthIt = 3;  // [nats]
  Configuration chosen = problem.configuration;
  Offsets& offsets = chosen.estimation.offsets;
  if (offsets != Offsets::automatic) return chosen;
  offsets = Offsets::estimate;
  if (problem.previous != nullptr &&
      problem.previous->configuration.estimation.offsets == Offsets::per_experiment)
    offsets = Offsets::per_experiment;
  const bool at_input = chosen.estimation.offset_side == OffsetSide::input;
  if (problem.data.count() < kFewest || at_input || hasGivenParameters(problem)) return chosen;
  CheckedData data;
  data.experiments = thinned(problem.data.experiments, kEnoughSamples);
  data.blocks = makeBlocks(data.experiments);
  const Problem simple{data, {}, nullptr, simpleModel(problem.configuration), {}, {}};
  // These fits precede the choice of orders, and count as the beginning of its phase.
  Journal beginning{ProgressPhases(
      [journal](const Progress&) { return journal->progress.report(Phase::orders, 0); })};
  const double common = densityWith(Offsets::estimate, simple, &beginning);
  if (beginning.progress.cancelled()) return chosen;
  const double own = densityWith(Offsets::per_experiment, simple, &beginning);
  journal->passes += beginning.passes;
  const bool differ = own > common + kWorthIt;
  if (differ) offsets = Offsets::per_experiment;
  journal->candidates.push_back({"offsets", "common", 0, {}, -2 * common, {}, !differ, {}});
  journal->candidates.push_back({"offsets", "of each experiment", 0, {}, -2 * own, {}, differ, {}});
  return chosen;
}

StructureFit withBetterOffsets(const Problem& problem, StructureFit fit, Journal* journal) {
  constexpr double kWorthIt = 1;  // [nats]
  Configuration own = fit.structure.configuration;
  if (own.estimation.offsets != Offsets::estimate || problem.data.count() < kFewest) return fit;
  own.estimation.offsets = Offsets::per_experiment;
  double highest = scoreAfterFirstSamples(problem, fit, journal) + kWorthIt;
  const StartingPoint start = fit.start();
  for (const bool white : {false, true}) {
    if (white) own.nominal_model.nc = own.nominal_model.nd = 0;
    auto other = fitStructure(problem, {fit.structure.description, own}, {start}, false, journal);
    if (!other) continue;
    const double score = scoreAfterFirstSamples(problem, *other, journal);
    if (score <= highest) continue;
    highest = score;
    fit = std::move(*other);
  }
  return fit;
}

}  // namespace uncertainty_identification
