#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "identification/mean_plant.h"
#include "identification/steps.h"
#include "identification/structure_fit.h"

/// One more lag in place of a delay.
namespace uncertainty_identification {
namespace {

using Names = std::vector<std::string>;

bool isDelayedChainOfLags(const StructureFit& fit) {
  constexpr int kMostLags = 3;  // with the one more
  const NominalModelOptions& nominal = fit.structure.configuration.nominal_model;
  return nominal.structure == Structure::continuous && nominal.resonances == 0 &&
         nominal.fixed.empty() && nominal.time_constants > 0 &&
         nominal.time_constants < kMostLags && (nominal.dead_time || nominal.delay > 1);
}

std::string lag(int number) { return "tau" + std::to_string(number); }

/// Go of the fit, with a lag that answers about as late as its delay does.
StartingPoint startOf(const StructureFit& fit, const NominalModel& with_lag, int lags,
                      double sample_time) {
  const NominalModel& nominal = fit.model->nominal();
  const Names before = nominal.names(), names = with_lag.names();
  std::map<std::string, double> known;
  for (std::size_t k = 0; k < before.size(); ++k)
    known[before[k]] = fit.point.parameters[static_cast<Eigen::Index>(k)];
  const int whole = fit.structure.configuration.nominal_model.delay;
  const auto dead_time = known.find("dead_time");
  known[lag(lags)] =
      (whole - 0.5) * sample_time + (dead_time == known.end() ? 0 : dead_time->second);
  Eigen::VectorXd theta(static_cast<Eigen::Index>(names.size()));
  for (std::size_t k = 0; k < names.size(); ++k)
    theta[static_cast<Eigen::Index>(k)] = known[names[k]];
  return {with_lag.polynomials(theta), fit.start().offset};
}

/// The parameters that may vary: those that did in the fit, also together with the further lag, and
/// all.
std::vector<Names> variedWith(const StructureFit& fit, int lags) {
  Names before = fit.structure.configuration.error_model.parameters;
  before.erase(std::remove(before.begin(), before.end(), "dead_time"), before.end());
  Names with_lag = before, all{"gain"};
  with_lag.push_back(lag(lags));
  for (int k = 1; k <= lags; ++k) all.push_back(lag(k));
  std::vector<Names> found;
  for (const Names& names : {before, with_lag, all})
    if (!names.empty() && std::find(found.begin(), found.end(), names) == found.end())
      found.push_back(names);
  return found;
}

}  // namespace

StructureFit withLagForDelay(const Problem& problem, StructureFit fit, Journal* journal) {
  const ErrorModelOptions& errors = fit.structure.configuration.error_model;
  if (!isDelayedChainOfLags(fit) || errors.basis != BasisKind::parameter_spread) return fit;
  Configuration configuration = fit.structure.configuration;
  NominalModelOptions& nominal = configuration.nominal_model;
  const int lags = ++nominal.time_constants;
  nominal.zeros = 0;
  nominal.dead_time = false;
  nominal.delay = 1;
  const double sample_time = problem.data.sampleTime();
  const StartingPoint start =
      startOf(fit, *makeNominalModel(nominal, sample_time), lags, sample_time);
  std::vector<StructureFit> fits{std::move(fit)};
  for (const Names& names : variedWith(fits.front(), lags)) {
    if (journal->progress.searchEnds()) break;
    const ErrorStructure structure = spreadOf(names, configuration);
    if (auto other = fitStructure(problem, structure, {start}, false, journal))
      if (plantsExist(*other)) fits.push_back(std::move(*other));
  }
  return fits.size() == 1 ? fits.front() : bestOf(problem, fits, "lag for delay", true, journal);
}

}  // namespace uncertainty_identification
