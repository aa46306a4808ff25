#include <algorithm>
#include <limits>

#include "estimation/excerpt.h"
#include "estimation/selection.h"
#include "identification/mean_plant.h"
#include "identification/short_gaps.h"
#include "identification/steps.h"
#include "identification/structure_fit.h"
#include "model/sensitivity.h"

/// The automatic choices of the error model and of the noise model, and whether Go is fitted
/// together with them.
namespace uncertainty_identification {
namespace {

/// The part of the data that is enough to compare structures: of long records the beginnings, with
/// short gaps filled where there is a plant to fill them by.
CheckedData enough(const Problem& problem) {
  constexpr int kAlways = 1000, kTogether = 8000;  // samples of each, and of few
  CheckedData part = problem.data;
  const int longest = std::max(kAlways, kTogether / part.count());
  part.experiments = fewerSamples(part.experiments, 2 * kEnoughSamples);
  for (Experiment& experiment : part.experiments)
    if (experiment.samples() > longest) experiment = excerpt(experiment, 0, longest);
  if (problem.plant)
    part.experiments = withShortGapsFilled(std::move(part.experiments), problem.plant->polynomials,
                                           problem.plant->offset, problem.configuration.estimation);
  part.blocks = makeBlocks(part.experiments);
  return part;
}

/// Whether Go is not the plant in the middle of its distribution, and simulates worse than that
/// one: a model that misleads whoever simulates it.
bool isBesideItsPlants(const Problem& problem, const StructureFit& fit) {
  if (fit.structure.configuration.error_model.constraint == Constraint::zero_mean) return false;
  const StartingPoint go = fit.start();
  return simulatesWorse(fitOf(problem, go.polynomials, go.offset),
                        fitOf(problem, meanPlant(fit), go.offset));
}

/// Whether what the structure depends on is better than no difference between the plants.
bool isWorthFitting(const Problem& problem, const ErrorStructure& structure,
                    const std::vector<StructureFit>& before) {
  if (structure.if_better.empty()) return true;
  double without = -std::numeric_limits<double>::infinity(), with = without;
  for (const StructureFit& fit : before) {
    if (fit.structure.description == structure.if_better) with = scoreOf(problem, fit);
    if (fit.mixture == 0) without = scoreOf(problem, fit);
  }
  return with > without;
}

/// Fits of the structures that can be fitted. Each starts from the best one before it.
std::vector<StructureFit> fitAll(const Problem& problem,
                                 const std::vector<ErrorStructure>& structures,
                                 const std::vector<StartingPoint>& points, Journal* journal) {
  constexpr std::size_t kFromData = 2;  // structures that also start from the data
  std::vector<StructureFit> fits;
  std::vector<StartingPoint> starts = points;
  double highest = -std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < structures.size(); ++k) {
    if (k > 0 && journal->progress.searchEnds()) break;
    if (!isWorthFitting(problem, structures[k], fits)) continue;
    auto fit = fitStructure(problem, structures[k], starts, k < kFromData, journal);
    journal->progress.report(Phase::structure,
                             static_cast<double>(k + 1) / static_cast<double>(structures.size()));
    const bool free = problem.configuration.error_model.basis == BasisKind::automatic;
    if (!fit || (free && (!plantsExist(*fit) || isBesideItsPlants(problem, *fit)))) continue;
    fits.push_back(std::move(*fit));
    const double score = scoreOf(problem, fits.back());
    if (score <= highest) continue;
    highest = score;
    starts.resize(points.size());
    starts.push_back(fits.back().start());
  }
  return fits;
}

/// The structures with the number of poles in their descriptions.
std::vector<ErrorStructure> ofOrder(Eigen::Index poles, std::vector<ErrorStructure> structures) {
  const std::string order = " (na=" + std::to_string(poles) + ")";
  for (ErrorStructure& structure : structures) {
    structure.description += order;
    if (!structure.if_better.empty()) structure.if_better += order;
  }
  return structures;
}

/// Fits of models with fewer poles than the problem's, as long as one pole less is better: more of
/// a plant's parameters that vary look like another pole. `orders` holds the models whose gain
/// varies, by decreasing order; a model that lacks more than all differences between the plants of
/// the first are worth is not tried.
std::vector<StructureFit> fitSmaller(Problem problem, const std::vector<StructureFit>& orders,
                                     double highest, Journal* journal) {
  std::vector<StructureFit> fits;
  for (std::size_t k = 1; k < orders.size(); ++k) {
    const StructureFit& each = orders[k];
    const double of_first = scoreOf(problem, orders.front());
    if (of_first - scoreOf(problem, each) > highest - of_first) break;
    const StartingPoint start = each.start();
    problem.configuration.nominal_model = each.structure.configuration.nominal_model;
    const std::vector<ErrorStructure> structures =
        ofOrder(start.polynomials.a.size(), variedStructures(problem, &start.polynomials));
    const double before = highest;
    for (StructureFit& fit : fitAll(problem, structures, {start}, journal)) {
      highest = std::max(highest, scoreOf(problem, fit));
      fits.push_back(std::move(fit));
    }
    if (highest == before) break;
  }
  return fits;
}

/// The fit with more poles or coefficients as long as its residuals depend on the input and BIC
/// improves. With too few poles, the differences between the plants seem to be what Go lacks: once
/// there are more, the structures are compared again.
StructureFit withRaisedOrders(Problem problem, const StructureFit& chosen, Journal* journal) {
  StructureFit raised = withBetterOrders(problem, chosen, true, journal);
  const NominalModelOptions& nominal = raised.structure.configuration.nominal_model;
  const StartingPoint start = raised.start();
  const Eigen::Index poles = start.polynomials.a.size();
  if (poles == chosen.start().polynomials.a.size() || nominal.structure != Structure::box_jenkins ||
      journal->progress.searchEnds())
    return raised;
  problem.configuration.nominal_model = nominal;
  std::vector<StructureFit> fits = fitAll(
      problem, ofOrder(poles, errorStructures(problem, &start.polynomials)), {start}, journal);
  fits.push_back(std::move(raised));
  return bestOf(problem, fits, "error model", true, journal);
}

/// The fit with larger orders of Go where the residuals depend on the input now that the noise is
/// modelled: hum or drift, while they were not, hid what Go lacks.
StructureFit withWhatNoiseHid(const Problem& problem, StructureFit chosen, Journal* journal) {
  const int before = chosen.parameters;
  StructureFit raised = withBetterOrders(problem, std::move(chosen), true, journal);
  if (raised.parameters == before) return raised;
  raised = withWholeDelay(problem, std::move(raised), journal);
  return withNoiseOrders(problem, raised, journal);
}

/// The structures but for those in which coefficients of A vary: modes that differ are as general,
/// and found faster.
std::vector<ErrorStructure> withoutSpreadOfCoefficients(std::vector<ErrorStructure> structures) {
  const auto varies_a = [](const ErrorStructure& structure) {
    const Configuration& configuration = structure.configuration;
    const std::vector<std::string>& names = configuration.error_model.parameters;
    return configuration.nominal_model.structure == Structure::box_jenkins &&
           configuration.error_model.basis == BasisKind::parameter_spread &&
           std::any_of(names.begin(), names.end(),
                       [](const std::string& name) { return name[0] == 'a'; });
  };
  structures.erase(std::remove_if(structures.begin(), structures.end(), varies_a),
                   structures.end());
  return structures;
}

/// What is free to be chosen.
struct Freedom {
  bool orders = false, offsets = false;
  bool joint_orders = false;  ///< the orders of Go by the likelihood, too
};

/// Whether modes that differ leave all other structures far behind.
bool areOutOfReach(const Problem& problem, const std::optional<StructureFit>& modes,
                   double highest) {
  constexpr double kFar = 5;  // [nats] of half BIC for each experiment
  return modes && scoreOf(problem, *modes) > highest + kFar * problem.data.count();
}

/// Fits of all structures with the order and from the plant of modes that differ.
std::vector<StructureFit> fitFrom(const StructureFit& modes, Problem problem, Journal* journal) {
  const StartingPoint start = modes.start();
  NominalModelOptions& nominal = problem.configuration.nominal_model;
  nominal.na = static_cast<int>(start.polynomials.a.size());
  nominal.nb = static_cast<int>(start.polynomials.b.size());
  nominal.delay = start.polynomials.delay;
  const auto structures = withoutSpreadOfCoefficients(errorStructures(problem, &start.polynomials));
  return fitAll(problem, ofOrder(start.polynomials.a.size(), structures), {start}, journal);
}

StructureFit chooseStructure(Problem problem, const Freedom& free,
                             std::vector<StartingPoint> points, Journal* journal) {
  const bool automatic = problem.configuration.error_model.basis == BasisKind::automatic;
  std::vector<StructureFit> orders;  // the best first
  if (free.joint_orders && !problem.plant) orders = jointOrders(problem, points, journal);
  if (!orders.empty()) {
    problem.configuration.nominal_model = orders.front().structure.configuration.nominal_model;
    points.insert(points.begin(), orders.front().start());
  }
  std::optional<StructureFit> modes;
  if (automatic && free.joint_orders && !problem.plant) modes = fitModes(problem, journal);
  std::vector<ErrorStructure> structures = errorStructures(
      problem, free.orders && !points.empty() ? &points.front().polynomials : nullptr);
  double highest =
      orders.empty() ? -std::numeric_limits<double>::infinity() : scoreOf(problem, orders.front());
  if (areOutOfReach(problem, modes, highest))
    structures = withoutSpreadOfCoefficients(std::move(structures));
  std::vector<StructureFit> fits = fitAll(problem, structures, points, journal);
  highest = -std::numeric_limits<double>::infinity();
  for (const StructureFit& fit : fits) highest = std::max(highest, scoreOf(problem, fit));
  bool are_modes = areOutOfReach(problem, modes, highest);
  for (StructureFit& fit : are_modes ? fitFrom(*modes, problem, journal)
                                     : fitSmaller(problem, orders, highest, journal)) {
    highest = std::max(highest, scoreOf(problem, fit));
    fits.push_back(std::move(fit));
  }
  are_modes = areOutOfReach(problem, modes, highest);
  StructureFit chosen =
      fits.size() == 1 ? fits.front() : bestOf(problem, fits, "error model", automatic, journal);
  if (!free.orders) return chosen;
  if (!problem.plant && !are_modes) {
    chosen = automatic ? withRaisedOrders(problem, chosen, journal)
                       : withBetterOrders(problem, std::move(chosen), true, journal);
    chosen = withWholeDelay(problem, std::move(chosen), journal);
    if (automatic) chosen = withLagForDelay(problem, std::move(chosen), journal);
    if (automatic && mayBeFilters(problem, fits, chosen) && !journal->progress.searchEnds())
      if (auto filters = fitFilters(problem, journal))
        chosen = bestOf(problem, {chosen, std::move(*filters)}, "filters with a free mean", true,
                        journal);
  }
  // Their directions come from all experiments, so that held-out ones would be no judge.
  if (modes) chosen = bestOf(problem, {chosen, std::move(*modes)}, "modes", false, journal);
  chosen = withNoiseOrders(problem, chosen, journal);
  if (!problem.plant) chosen = withWhatNoiseHid(problem, std::move(chosen), journal);
  return free.offsets ? withBetterOffsets(problem, std::move(chosen), journal) : chosen;
}

/// The problem of comparing structures, which part of the data is enough for.
Problem partOf(const Problem& problem, const CheckedData& part, bool free_orders, PlantFit fit) {
  Problem own{part, problem.nominal_model, problem.previous, problem.configuration, {}, {}};
  NominalModelOptions& nominal = own.configuration.nominal_model;
  if (free_orders) {
    nominal.structure = Structure::box_jenkins;
    nominal.nc = nominal.nd = 1;
  }
  nominal.fit = fit;
  return own;
}

std::vector<StartingPoint> startsOf(const Problem& problem) {
  if (!problem.plant) return {};
  return {{problem.plant->polynomials, problem.plant->offset}};
}

}  // namespace

ModelChoice chooseAroundPlant(const Problem& problem, const Configuration& asked,
                              Journal* journal) {
  const CheckedData data = enough(problem);
  const bool free_orders = asked.nominal_model.orders_auto;
  Problem part = partOf(problem, data, free_orders, PlantFit::simulation);
  part.plant = problem.plant;
  const StructureFit fit =
      chooseStructure(part, {free_orders, false, false}, startsOf(problem), journal);
  return {fit.structure.configuration, true, fit.point.parameters, fit.point, fit.points};
}

ModelChoice chooseModel(const Problem& problem, const Configuration& asked, Orders orders,
                        Journal* journal) {
  const bool free_orders = asked.nominal_model.orders_auto;
  const bool free_offsets = asked.estimation.offsets == Offsets::automatic;
  const ErrorModelOptions& given = problem.configuration.error_model;
  const bool free_error_model = given.basis == BasisKind::automatic || given.taps == kAutomatic;
  if (!free_orders && !free_error_model) {
    ModelChoice choice{problem.configuration, problem.plant.has_value(), {}};
    completeErrorModel(*remainingNominalModel(problem), &choice.configuration.error_model);
    Problem completed = problem;
    completed.configuration = choice.configuration;
    if (const auto fit = fitStatedModes(completed, journal)) {
      choice.reached = fit->point;
      choice.points = fit->points;
    }
    return choice;
  }
  const bool joint = free_orders && asked.nominal_model.fit == PlantFit::likelihood;
  if (problem.plant && !joint) return chooseAroundPlant(problem, asked, journal);
  const CheckedData data = enough(problem);
  const Problem part = partOf(problem, data, free_orders, PlantFit::likelihood);
  const bool automatic = part.configuration.error_model.basis == BasisKind::automatic;
  const Freedom free{free_orders, free_offsets,
                     free_orders && (automatic || orders == Orders::of_likelihood)};
  const StructureFit fit = chooseStructure(part, free, startsOf(problem), journal);
  return {fit.structure.configuration, false, fit.point.parameters, fit.point, fit.points};
}

}  // namespace uncertainty_identification
