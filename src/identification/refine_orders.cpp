#include <algorithm>
#include <cmath>
#include <limits>

#include "estimation/excerpt.h"
#include "estimation/least_squares_start.h"
#include "identification/mean_plant.h"
#include "identification/structure_fit.h"
#include "math/polynomial.h"
#include "residual_tests/residual_tests.h"

/// Orders that the simulation of the nominal model alone cannot show, because the differences
/// between the plants are larger than what is missing, as a fraction of a sample of delay or a fast
/// pole, or look like what is too much.
namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// A structure of the next size, with a point of it that has the response of the smaller one.
struct Neighbour {
  ErrorStructure structure;
  StartingPoint start;
};

VectorXd withZero(const VectorXd& coefficients, bool in_front) {
  VectorXd longer = VectorXd::Zero(coefficients.size() + 1);
  longer.segment(in_front ? 1 : 0, coefficients.size()) = coefficients;
  return longer;
}

std::vector<Neighbour> largerContinuous(const ErrorStructure& structure,
                                        const StartingPoint& start) {
  constexpr double kFastPole = 0.05;  // 3 time constants within a sample
  std::vector<Neighbour> all{{structure, start}};
  ++all[0].structure.configuration.nominal_model.time_constants;
  all[0].start.polynomials.a = multiply(start.polynomials.a, VectorXd::Constant(1, -kFastPole));
  NominalModelOptions delayed = structure.configuration.nominal_model;
  if (delayed.dead_time || delayed.delay < 1) return all;
  delayed.dead_time = true;
  delayed.max_delay = 3;  // samples beyond a delay that is a sample shorter
  delayed.delay = std::max(1, delayed.delay - 1);
  all.push_back({structure, start});
  all.back().structure.configuration.nominal_model = delayed;
  return all;
}

std::vector<Neighbour> largerRational(const ErrorStructure& structure, const StartingPoint& start) {
  const Polynomials& p = start.polynomials;
  const auto larger = [&](bool zero, bool pole) {
    Neighbour each{structure, start};
    NominalModelOptions& nominal = each.structure.configuration.nominal_model;
    nominal.nb += zero ? 1 : 0;
    nominal.na += pole ? 1 : 0;
    if (zero) each.start.polynomials.b = withZero(p.b, false);
    if (pole) each.start.polynomials.a = withZero(p.a, false);
    return each;
  };
  std::vector<Neighbour> all = {larger(true, false), larger(true, true), larger(false, true)};
  if (p.delay == 0) return all;
  all.push_back(larger(true, false));
  --all.back().structure.configuration.nominal_model.delay;
  --all.back().start.polynomials.delay;
  all.back().start.polynomials.b = withZero(p.b, true);
  return all;
}

bool dependsOnInput(const Problem& problem, const StructureFit& fit) {
  constexpr double kImprobable = 0.01;
  const ResidualTests tests = residualTests(*fit.model, problem.data.blocks, fit.point.parameters);
  return tests.samples > 0 && tests.independence_p_value < kImprobable;
}

}  // namespace

StructureFit withBetterOrders(const Problem& problem, StructureFit fit, bool only_if_dependent,
                              Journal* journal) {
  constexpr int kRounds = 3;
  constexpr double kWorthIt = 2;  // [nats] beyond the penalty
  const int largest = problem.configuration.nominal_model.max_order;
  for (int round = 0; round < kRounds && !journal->progress.searchEnds(); ++round) {
    const StartingPoint start = fit.start();
    if (start.polynomials.a.size() >= largest) return fit;
    if (only_if_dependent && !dependsOnInput(problem, fit)) return fit;
    const ErrorStructure& structure = fit.structure;
    if (structure.configuration.nominal_model.structure == Structure::modal) return fit;
    const bool continuous =
        structure.configuration.nominal_model.structure == Structure::continuous;
    double highest = scoreOf(problem, fit) + kWorthIt;
    std::optional<StructureFit> better;
    for (const Neighbour& each :
         continuous ? largerContinuous(structure, start) : largerRational(structure, start)) {
      auto larger = fitStructure(problem, each.structure, {each.start}, true, journal);
      if (!larger || scoreOf(problem, *larger) < highest || !plantsExist(*larger)) continue;
      highest = scoreOf(problem, *larger);
      better = std::move(larger);
    }
    if (!better) return fit;
    fit = std::move(*better);
  }
  return fit;
}

namespace {

/// The delays with which a model of nb = na = `order` explains the data best by least squares.
std::vector<int> likelyDelays(const Problem& problem, int order) {
  std::vector<const Experiment*> all;
  int shortest = problem.data.experiments.front().samples();
  for (const Experiment& experiment : problem.data.experiments) {
    all.push_back(&experiment);
    shortest = std::min(shortest, experiment.samples());
  }
  const Configuration& configuration = problem.configuration;
  const LeastSquaresStart scan(all, constantOf(configuration.estimation.offsets), kEnoughSamples);
  const int longest = std::min(configuration.nominal_model.max_delay, shortest / 4);
  return scan.likelyDelays(order, order, longest);
}

/// The fit or, where BIC is lower, that with a longer or a shorter delay.
StructureFit withBetterDelay(const Problem& problem, StructureFit fit, Journal* journal) {
  for (const int step : {1, -1}) {
    for (bool better = true; better && !journal->progress.searchEnds();) {
      ErrorStructure structure = fit.structure;
      StartingPoint start = fit.start();
      start.polynomials.delay += step;
      int& delay = structure.configuration.nominal_model.delay;
      delay += step;
      if (delay < 0 || delay > problem.configuration.nominal_model.max_delay) break;
      auto other = fitStructure(problem, structure, {start}, false, journal);
      better = other && scoreOf(problem, *other) > scoreOf(problem, fit);
      if (better) fit = std::move(*other);
    }
  }
  return fit;
}

void record(const Problem& problem, const StructureFit& fit, Journal* journal) {
  const NominalModelOptions& nominal = fit.structure.configuration.nominal_model;
  journal->candidates.push_back(
      {problem.data.count() == 1 ? "orders, noise modelled" : "orders, gain varies",
       "nb=" + std::to_string(nominal.nb) + " na=" + std::to_string(nominal.na) +
           " delay=" + std::to_string(nominal.delay),
       fit.parameters + fit.mixture,
       fit.log_likelihood,
       -2 * scoreOf(problem, fit),
       {},
       false,
       {}});
}

Index polesOf(const StructureFit& fit) { return fit.start().polynomials.a.size(); }

}  // namespace

ErrorStructure structureForOrders(const Problem& problem) {
  if (problem.data.count() == 1) return {"none", problem.configuration};
  ErrorStructure gain{"gain", problem.configuration};
  ErrorModelOptions& errors = gain.configuration.error_model;
  errors.basis = BasisKind::fir;
  errors.constraint = Constraint::zero_mean;
  errors.taps = 1;
  return gain;
}

std::optional<StructureFit> fitOfOrder(Problem problem, int order, Journal* journal) {
  NominalModelOptions& nominal = problem.configuration.nominal_model;
  nominal.nb = nominal.na = order;
  std::optional<StructureFit> best;
  for (const int delay : likelyDelays(problem, order)) {
    if (best && journal->progress.searchEnds()) break;
    nominal.delay = delay;
    auto fit = fitStructure(problem, structureForOrders(problem), {}, true, journal);
    if (fit && (!best || scoreOf(problem, *fit) > scoreOf(problem, *best))) best = std::move(fit);
  }
  if (best) best = withBetterDelay(problem, std::move(*best), journal);
  return best;
}

std::vector<StructureFit> jointOrders(const Problem& problem,
                                      const std::vector<StartingPoint>& points, Journal* journal) {
  constexpr int kWorse = 2;        // orders in turn without a lower BIC
  std::vector<StructureFit> fits;  // by increasing order
  std::size_t best = 0;
  const auto adopt = [&](std::optional<StructureFit> fit) {
    if (!fit) return;
    fits.push_back(std::move(*fit));
    record(problem, fits.back(), journal);
    if (scoreOf(problem, fits.back()) > scoreOf(problem, fits[best])) best = fits.size() - 1;
  };
  const int largest = problem.configuration.nominal_model.na;
  for (int order = 1; order < largest && fits.size() <= best + kWorse; ++order)
    adopt(fitOfOrder(problem, order, journal));
  if (auto fit = fitStructure(problem, structureForOrders(problem), points, true, journal))
    adopt(withBetterDelay(problem, std::move(*fit), journal));
  if (fits.empty()) return fits;
  fits.resize(best + 1, fits.front());
  std::reverse(fits.begin(), fits.end());
  StructureFit raised = withBetterOrders(problem, fits.front(), false, journal);
  if (polesOf(raised) == polesOf(fits.front())) fits.erase(fits.begin());
  fits.insert(fits.begin(), std::move(raised));
  record(problem, fits.front(), journal);
  journal->candidates.back().chosen = true;
  return fits;
}

StructureFit withWholeDelay(const Problem& problem, StructureFit fit, Journal* journal) {
  constexpr double kWhole = 0.1;  // [samples]
  ErrorStructure whole = fit.structure;
  NominalModelOptions& nominal = whole.configuration.nominal_model;
  const std::vector<std::string>& varied = whole.configuration.error_model.parameters;
  const std::vector<std::string> names = fit.model->names();
  const auto k = std::find(names.begin(), names.end(), "dead_time") - names.begin();
  if (!nominal.dead_time || k == static_cast<long>(names.size()) ||
      std::find(varied.begin(), varied.end(), "dead_time") != varied.end())
    return fit;
  const double samples = fit.point.parameters[k] / problem.data.sampleTime();
  if (std::abs(samples - std::round(samples)) > kWhole) return fit;
  nominal.dead_time = false;
  nominal.delay += static_cast<int>(std::round(samples));
  const auto with = fitStructure(problem, whole, {fit.start()}, false, journal);
  return with && scoreOf(problem, *with) > scoreOf(problem, fit) ? *with : fit;
}

}  // namespace uncertainty_identification
