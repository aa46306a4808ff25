#include <algorithm>
#include <cmath>

#include "identification/structure_fit.h"
#include "math/polynomial.h"
#include "residual_tests/residual_tests.h"

/// Orders that the simulation of the nominal model alone cannot show, because the differences
/// between the plants are larger than what is missing: a fraction of a sample of delay, a fast
/// pole.
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
  std::vector<Neighbour> all(3, {structure, start});
  for (Neighbour& each : all) ++each.structure.configuration.nominal_model.nb;
  for (Neighbour& each : all) each.start.polynomials.b = withZero(p.b, false);
  ++all[1].structure.configuration.nominal_model.na;
  all[1].start.polynomials.a = withZero(p.a, false);
  if (p.delay == 0) {
    all.pop_back();
    return all;
  }
  --all[2].structure.configuration.nominal_model.delay;
  --all[2].start.polynomials.delay;
  all[2].start.polynomials.b = withZero(p.b, true);
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
  const auto samples = static_cast<double>(problem.data.validSamples());
  const int largest = problem.configuration.nominal_model.max_order;
  for (int round = 0; round < kRounds && !journal->progress.cancelled(); ++round) {
    const StartingPoint start = fit.start();
    if (start.polynomials.a.size() >= largest) return fit;
    if (only_if_dependent && !dependsOnInput(problem, fit)) return fit;
    const ErrorStructure& structure = fit.structure;
    const bool continuous =
        structure.configuration.nominal_model.structure == Structure::continuous;
    double highest = fit.score(samples, problem.data.count()) + kWorthIt;
    std::optional<StructureFit> better;
    for (const Neighbour& each :
         continuous ? largerContinuous(structure, start) : largerRational(structure, start)) {
      auto larger = fitStructure(problem, each.structure, {each.start}, true, journal);
      if (!larger || larger->score(samples, problem.data.count()) < highest) continue;
      highest = larger->score(samples, problem.data.count());
      better = std::move(larger);
    }
    if (!better) return fit;
    fit = std::move(*better);
  }
  return fit;
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
  const auto score = [&](const StructureFit& of) {
    return of.score(static_cast<double>(problem.data.validSamples()), problem.data.count());
  };
  return with && score(*with) > score(fit) ? *with : fit;
}

}  // namespace uncertainty_identification
