#include <limits>
#include <optional>

#include "estimation/excerpt.h"
#include "identification/mean_plant.h"
#include "identification/own_levels.h"
#include "identification/steps.h"
#include "identification/structure_fit.h"
#include "model/evaluation.h"

/// Whether each experiment has an operating point of its own.
namespace uncertainty_identification {
namespace {

/// A simple nominal model whose noise is coloured.
Configuration simpleModel(Configuration simple) {
  NominalModelOptions nominal;
  nominal.structure = Structure::box_jenkins;
  nominal.fit = PlantFit::likelihood;
  nominal.nc = nominal.nd = 1;
  nominal.max_delay = simple.nominal_model.max_delay;
  nominal.orders_auto = false;
  simple.nominal_model = nominal;
  simple.effects.clear();
  return simple;
}

/// A fit and half its BIC by what follows the first samples, which determine an offset.
struct Scored {
  std::optional<StructureFit> fit{};
  double score = -std::numeric_limits<double>::infinity();

  void adopt(std::optional<StructureFit> other, const Problem& problem, Journal* journal) {
    const double its = other ? scoreAfterFirstSamples(problem, *other, journal) : score;
    if (!(its > score)) return;
    fit = std::move(other);
    score = its;
  }
};

/// The best of first- and second-order models with gains that vary, and of first-order ones with
/// two parameters that do. One order alone would not do: a pole too many integrates, and its state
/// is an offset.
Scored bestWith(Offsets offsets, Problem problem, Journal* journal) {
  problem.configuration.estimation.offsets = offsets;
  NominalModelOptions& nominal = problem.configuration.nominal_model;
  Scored best;
  for (const int order : {1, 2}) {
    if (journal->progress.searchEnds()) break;
    auto fit = fitOfOrder(problem, order, journal);
    if (!fit) continue;
    const StartingPoint start = fit->start();
    best.adopt(std::move(fit), problem, journal);
    if (order > 1 || journal->progress.searchEnds()) continue;
    nominal.nb = nominal.na = order;
    nominal.delay = start.polynomials.delay;
    for (const ErrorStructure& structure : variedStructures(problem, &start.polynomials)) {
      if (structure.configuration.error_model.parameters.size() == 2)
        best.adopt(fitStructure(problem, structure, {start}, false, journal), problem, journal);
    }
  }
  return best;
}

/// Whether own offsets, as the first samples show them, simulate the data as well as a common one.
/// They do not where the plant is not linear, and the offsets take up what the model lacks.
bool simulatesAsWell(Problem problem, const StructureFit& own, const StructureFit& common) {
  const auto simulated = [&problem](const StructureFit& fit) {
    problem.configuration.estimation = fit.structure.configuration.estimation;
    return fitOf(problem, meanPlant(fit), fit.start().offset);
  };
  return !simulatesWorse(simulated(own), simulated(common));
}

}  // namespace

bool mayHaveOwnOffsets(const Problem& problem) {
  constexpr int kFewest = 3;
  return problem.data.movedInputs() >= kFewest && !problem.data.single_steps &&
         problem.configuration.estimation.offset_side == OffsetSide::output &&
         !hasGivenParameters(problem) &&
         (estimatesInitialState(problem.configuration.estimation) ||
          levelsAtRestDiffer(problem.data.experiments, problem.configuration.estimation));
}

Configuration chooseOffsets(const Problem& problem, Journal* journal) {
  constexpr double kWorthIt = 3;           // [nats]
  constexpr int kEnoughForOffsets = 6000;  // samples
  Configuration chosen = problem.configuration;
  Offsets& offsets = chosen.estimation.offsets;
  if (offsets != Offsets::automatic) return chosen;
  offsets = Offsets::estimate;
  if (problem.previous != nullptr &&
      problem.previous->configuration.estimation.offsets == Offsets::per_experiment)
    offsets = Offsets::per_experiment;
  if (!mayHaveOwnOffsets(problem)) return chosen;
  CheckedData data;
  data.experiments = fewerSamples(problem.data.experiments, kEnoughForOffsets);
  data.blocks = makeBlocks(data.experiments);
  const Problem simple{data, {}, nullptr, simpleModel(problem.configuration), {}, {}};
  // These fits precede the choice of orders, and count as the beginning of its phase.
  Journal beginning{ProgressPhases(
      [journal](const Progress&) { return journal->progress.report(Phase::orders, 0); })};
  const Scored common = bestWith(Offsets::estimate, simple, &beginning);
  const Scored own = bestWith(Offsets::per_experiment, simple, &beginning);
  journal->passes += beginning.passes;
  if (!common.fit || !own.fit || beginning.progress.searchEnds()) return chosen;
  const bool differ = own.score > common.score + kWorthIt &&
                      simulatesAsWell(simple, *own.fit, *common.fit) &&
                      levelsDiffer(problem.data.experiments);
  if (differ) offsets = Offsets::per_experiment;
  journal->candidates.push_back({"offsets", "common", 0, {}, -2 * common.score, {}, !differ, {}});
  journal->candidates.push_back(
      {"offsets", "of each experiment", 0, {}, -2 * own.score, {}, differ, {}});
  return chosen;
}

StructureFit withBetterOffsets(const Problem& problem, StructureFit fit, Journal* journal) {
  constexpr double kWorthIt = 1;  // [nats]
  Configuration own = fit.structure.configuration;
  if (own.estimation.offsets != Offsets::estimate || !mayHaveOwnOffsets(problem)) return fit;
  own.estimation.offsets = Offsets::per_experiment;
  Scored best;
  best.score = scoreAfterFirstSamples(problem, fit, journal) + kWorthIt;
  for (const bool white : {false, true}) {
    if (white) own.nominal_model.nc = own.nominal_model.nd = 0;
    best.adopt(
        fitStructure(problem, {fit.structure.description, own}, {fit.start()}, false, journal),
        problem, journal);
  }
  return best.fit && simulatesAsWell(problem, *best.fit, fit) ? *best.fit : fit;
}

}  // namespace uncertainty_identification
