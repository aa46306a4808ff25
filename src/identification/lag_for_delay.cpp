#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "identification/mean_plant.h"
#include "identification/steps.h"
#include "identification/structure_fit.h"

/// One more lag in place of a delay.
namespace uncertainty_identification {
namespace {

using Names = std::vector<std::string>;

bool isDelayedChainOfLags(const StructureFit& fit) {
  const NominalModelOptions& nominal = fit.structure.configuration.nominal_model;
  return nominal.structure == Structure::continuous && nominal.resonances == 0 &&
         nominal.fixed.empty() && nominal.time_constants > 0 &&
         (nominal.dead_time || nominal.delay > 1);
}

/// Whether the data and the configuration allow as many poles.
bool allows(const Problem& problem, int poles) {
  constexpr int kMost = 3, kSamplesEach = 40;
  const int asked = problem.configuration.nominal_model.max_order;
  return poles <= std::min(kMost, asked) && !problem.data.single_steps &&
         problem.data.validSamples() >= kSamplesEach * poles;
}

std::string lag(int number) { return "tau" + std::to_string(number); }

/// A time constant [s], and whether it varies from experiment to experiment.
struct Lag {
  double tau = 0;
  bool varies = false, is_new = false;
};

bool isFaster(const Lag& one, const Lag& other) { return one.tau < other.tau; }

/// The lags of the fit, the slowest first, as a model that starts from polynomials numbers them,
/// and one that answers about as late as its delay does. If there may be no further one, the
/// fastest is so much later.
std::vector<Lag> lagsOf(const StructureFit& fit, double sample_time, bool may_add) {
  const NominalModelOptions& options = fit.structure.configuration.nominal_model;
  const Names names = fit.model->nominal().names(),
              &varied = fit.structure.configuration.error_model.parameters;
  double late = (options.delay - 0.5) * sample_time;
  std::vector<Lag> lags;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const double value = fit.point.parameters[static_cast<Eigen::Index>(k)];
    if (names[k] == "dead_time") late += value;
    if (names[k].rfind("tau", 0) == 0)
      lags.push_back({value, std::find(varied.begin(), varied.end(), names[k]) != varied.end()});
  }
  const auto fastest = std::min_element(lags.begin(), lags.end(), isFaster);
  if (may_add)
    lags.push_back({late, false, true});
  else
    fastest->tau += late - 0.5 * sample_time;
  std::stable_sort(lags.begin(), lags.end(),
                   [](const Lag& left, const Lag& right) { return isFaster(right, left); });
  return lags;
}

/// Go of the fit with these lags and no delay but that of the hold.
StartingPoint startOf(const StructureFit& fit, const NominalModel& with_lag,
                      const std::vector<Lag>& lags) {
  const Names before = fit.model->nominal().names(), names = with_lag.names();
  std::map<std::string, double> known;
  for (std::size_t k = 0; k < before.size(); ++k)
    known[before[k]] = fit.point.parameters[static_cast<Eigen::Index>(k)];
  for (std::size_t k = 0; k < lags.size(); ++k) known[lag(static_cast<int>(k) + 1)] = lags[k].tau;
  Eigen::VectorXd theta(static_cast<Eigen::Index>(names.size()));
  for (std::size_t k = 0; k < names.size(); ++k)
    theta[static_cast<Eigen::Index>(k)] = known[names[k]];
  return {with_lag.polynomials(theta), fit.start().offset};
}

/// The parameters that may vary: those that did in the fit, the same and the further lag, and all.
std::vector<Names> variedWith(const StructureFit& fit, const std::vector<Lag>& lags) {
  const Names& varied = fit.structure.configuration.error_model.parameters;
  Names before, with_lag, all{"gain"};
  if (std::find(varied.begin(), varied.end(), "gain") != varied.end()) before = with_lag = {"gain"};
  for (std::size_t k = 0; k < lags.size(); ++k) {
    const std::string name = lag(static_cast<int>(k) + 1);
    if (lags[k].varies) before.push_back(name);
    if (lags[k].varies || lags[k].is_new) with_lag.push_back(name);
    all.push_back(name);
  }
  std::vector<Names> found;
  for (const Names& names : {before, with_lag, all})
    if (!names.empty() && std::find(found.begin(), found.end(), names) == found.end())
      found.push_back(names);
  return found;
}

}  // namespace

StructureFit withLagForDelay(const Problem& problem, StructureFit fit, Journal* journal) {
  Configuration configuration = fit.structure.configuration;
  if (!isDelayedChainOfLags(fit) ||
      configuration.error_model.basis != BasisKind::parameter_spread ||
      !allows(problem, configuration.nominal_model.time_constants))
    return fit;
  NominalModelOptions& nominal = configuration.nominal_model;
  const bool may_add = allows(problem, nominal.time_constants + 1);
  if (may_add) ++nominal.time_constants;
  nominal.zeros = 0;
  nominal.dead_time = false;
  nominal.delay = 1;
  const double sample_time = problem.data.sampleTime();
  const std::vector<Lag> lags = lagsOf(fit, sample_time, may_add);
  const StartingPoint start = startOf(fit, *makeNominalModel(nominal, sample_time), lags);
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
