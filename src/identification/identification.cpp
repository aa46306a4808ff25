#include "identification/identification.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <thread>

#include "data/check.h"
#include "effects/extended_model.h"
#include "estimation/initial_guess.h"
#include "estimation/linearisation.h"
#include "estimation/selection.h"
#include "estimation/simulation_fit.h"
#include "model/held_plant.h"
#include "model/sensitivity_model.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/version.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Identification::Identification(const Configuration& configuration,
                               const NominalModelFactory& nominal_model,
                               const ProgressCallback& progress)
    : factory_(nominal_model), progress_(progress) {
  estimate_.configuration = configuration;
  estimate_.version = version();
}

Estimate Identification::run(const std::vector<Experiment>& experiments,
                             const std::vector<Experiment>& validation, const Estimate* previous) {
  checkData(experiments);
  limitErrorModel();
  chooseOrders();
  fitPlant(previous);
  chooseTaps();
  buildModel();
  checkSizes();
  climb(start(previous));
  describe();
  if (cancelled_) {
    estimate_.termination = Termination::cancelled;
    estimate_.message = "cancelled";
  } else {
    validate(validation);
  }
  estimate_.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - began_).count();
  return std::move(estimate_);
}

void Identification::checkData(const std::vector<Experiment>& experiments) {
  report("checking the data", 0, kUnknown);
  const Configuration& configuration = estimate_.configuration;
  std::vector<std::string> covariates;
  for (const SignalOptions& covariate : configuration.covariates)
    covariates.push_back(covariate.name);
  const CheckReport checked =
      checkExperiments(experiments, configuration.limits, covariates, configuration.sample_time);
  estimate_.rejected = checked.rejected;
  estimate_.warnings = checked.warnings;
  for (int r : checked.usable) experiments_.push_back(experiments[static_cast<std::size_t>(r)]);
  if (experiments_.empty()) {
    std::string reasons;
    for (const RejectedExperiment& rejected : checked.rejected) reasons += "\n  " + rejected.reason;
    throw DataError(experiments.empty() ? "no experiments were given"
                                        : "no usable experiment is left:" + reasons);
  }
  sample_time_ = experiments_.front().sample_time;
  estimate_.data_fingerprint = dataFingerprint(experiments_);
  estimate_.experiment_count = static_cast<int>(experiments_.size());
  for (const Experiment& experiment : experiments_)
    estimate_.sample_count += experiment.validSamples();
}

void Identification::limitErrorModel() {
  constexpr std::size_t kFewest = 4;  // experiments that can carry a mixture
  ErrorModelOptions& options = estimate_.configuration.error_model;
  if (options.taps == 0) options.components = 1;
  if (experiments_.size() >= kFewest || options.taps == 0) return;
  if (experiments_.size() == 1) {
    options.taps = 0;
    options.components = 1;
    options.constraint = Constraint::free;
    estimate_.warnings.push_back(
        "one experiment shows no spread of the plant: a plain nominal model was identified; record "
        "more experiments to "
        "learn its uncertainty");
  } else if (options.components != 1) {
    options.components = 1;
    estimate_.warnings.push_back(
        std::to_string(experiments_.size()) +
        " experiments cannot carry a mixture: one Gaussian component was identified; a mixture "
        "needs at least 4 experiments, better 20");
  }
}

void Identification::chooseOrders() {
  NominalModelOptions& options = estimate_.configuration.nominal_model;
  if (!options.orders_auto) return;
  options = selectOrders(
      estimate_.configuration, sample_time_, experiments_, threads(), &estimate_.candidates,
      [this](double share) { return report("choosing orders", 0.05 + 0.5 * share, kUnknown); });
  options.orders_auto = false;
  choose_noise_ = options.fit == PlantFit::simulation;
}

void Identification::chooseTaps() {
  ErrorModelOptions& options = estimate_.configuration.error_model;
  if (options.taps != kAutomatic || variesParameters(options.basis)) return;
  const int fewest = options.constraint == Constraint::zero_static_gain ? 2 : 1;
  double lowest = std::numeric_limits<double>::infinity();
  std::size_t chosen = 0;
  int taps = fewest;
  for (options.taps = fewest; options.taps <= std::max(options.max_taps, fewest); ++options.taps) {
    buildModel();
    const ModelParameters single =
        bestSingleComponent(*likelihood_, starts(), climbOptions("choosing taps", 0.55, 0.6));
    if (single.mixture.components() == 0) continue;
    const Statistics statistics = likelihood_->statistics(single.parameters, false);
    Candidate candidate{"taps", "taps=" + std::to_string(options.taps), 0, 0, 0, kUnknown, false};
    const int mixture = mixtureParameters(options.constraint, model_->regressors(), 1);
    candidate.parameters = model_->parameterCount() + 1 + mixture;
    candidate.log_likelihood = likelihood_->expect(statistics, single).total();
    candidate.bic = bic(candidate.log_likelihood, model_->parameterCount() + 1, mixture,
                        statistics.samples().sum(), estimate_.experiment_count);
    estimate_.candidates.push_back(candidate);
    if (candidate.bic < lowest) {
      lowest = candidate.bic;
      chosen = estimate_.candidates.size() - 1;
      taps = options.taps;
    }
  }
  options.taps = taps;
  if (std::isfinite(lowest)) estimate_.candidates[chosen].chosen = true;
}

std::shared_ptr<const NominalModel> Identification::nominalModel() const {
  return factory_ ? factory_(sample_time_)
                  : makeNominalModel(estimate_.configuration.nominal_model, sample_time_);
}

void Identification::buildModel() {
  const Configuration& configuration = estimate_.configuration;
  const NominalModelOptions& options = configuration.nominal_model;
  const bool white = options.structure == Structure::output_error;
  nominal_ = plant_.has_value() ? holdPlant(*plant_, white ? 0 : options.nc, white ? 0 : options.nd)
                                : nominalModel();
  completeErrorModel(*nominal_, &estimate_.configuration.error_model);
  if (blocks_.empty()) blocks_ = makeBlocks(experiments_);
  if (configuration.effects.empty()) {
    adopt(makeLinearModel(nominal_, configuration.error_model, configuration.estimation));
  } else {
    adopt(makeExtendedModel(nominal_, configuration, experiments_));
  }
}

void Identification::adopt(std::unique_ptr<LinearModel> model) {
  if (likelihood_ != nullptr) estimate_.passes += likelihood_->passes();
  auto likelihood =
      std::make_unique<Likelihood>(*model, blocks_, estimate_.experiment_count, threads());
  likelihood_ = std::move(likelihood);
  model_ = std::move(model);
}

void Identification::checkSizes() const {
  const int parameters = model_->parameterCount() + 1;
  Response response;
  const VectorXd anywhere = model_->fromUnbounded(VectorXd::Zero(model_->parameterCount()));
  model_->evaluate(blocks_.back(), anywhere, false, &response);
  const long nuisances =
      static_cast<long>(response.column_precision.size()) * estimate_.experiment_count;
  if (estimate_.sample_count < 2 * (parameters + nuisances)) {
    throw DataError(
        "the orders are too large for the data: " + std::to_string(parameters) +
        " parameters and " + std::to_string(nuisances) +
        " unknown initial values or offsets against " + std::to_string(estimate_.sample_count) +
        " measured samples; lower the orders (nominal_model: nb, na, nc, nd, delay), set "
        "estimation.initial_state: zero if the experiments start at rest, or record longer "
        "experiments");
  }
}

void Identification::climb(const ModelParameters& start) {
  const EstimationOptions& options = estimate_.configuration.estimation;
  at_ = start;
  settle();
  if (options.max_iterations == 0) {
    const Expectation e =
        likelihood_->expect(likelihood_->statistics(start.parameters, false), start);
    estimate_.log_likelihood = e.total();
    estimate_.message = "evaluated at the start, as max_iterations: 0 asks";
    return;
  }
  ClimbOptions climbing = climbOptions("climbing", 0.75, 0.95);
  climbing.floor = covarianceFloor(start.mixture);
  climbOnce(climbing);
  climbToStandingPoints(climbing);
  reportFloor(climbing.floor);
}

void Identification::climbOnce(ClimbOptions options) {
  options.max_iterations = std::max(1, options.max_iterations - estimate_.iterations);
  Climb climb = estimate_.configuration.estimation.algorithm == Algorithm::em
                    ? expectationMaximisation(*likelihood_, at_, options)
                    : maximumLikelihood(*likelihood_, at_, options);
  at_ = std::move(climb.at);
  at_.mixture.sortComponents();
  estimate_.log_likelihood = climb.log_likelihood;
  estimate_.termination = cancelled_ ? Termination::cancelled : climb.termination;
  estimate_.message = climb.message;
  for (TracePoint point : climb.trace) {
    point.iteration += estimate_.iterations;
    point.passes += estimate_.passes;
    estimate_.trace.push_back(point);
  }
  estimate_.iterations += climb.iterations;
}

void Identification::reportFloor(const MatrixXd& floor) {
  for (std::size_t i = 0; floor.size() > 0 && i < at_.mixture.covariances.size(); ++i) {
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(at_.mixture.covariances[i],
                                                                   floor);
    if (eigen.eigenvalues().minCoeff() > 1.01) continue;
    estimate_.warnings.push_back(
        "the covariance of component " + std::to_string(i + 1) +
        " stands at its lower limit in a direction: the experiments there hardly differ, or the "
        "component holds too few of them");
  }
}

void Identification::validate(const std::vector<Experiment>& validation) {
  if (validation.empty()) return;
  const Configuration& configuration = estimate_.configuration;
  const CheckReport checked = checkExperiments(validation, configuration.limits, {}, sample_time_);
  for (const RejectedExperiment& rejected : checked.rejected) {
    estimate_.warnings.push_back("validation: " + rejected.reason);
  }
  std::vector<Experiment> used;
  for (int r : checked.usable) used.push_back(validation[static_cast<std::size_t>(r)]);
  if (used.empty()) throw DataError("no usable experiment is left for validation");
  for (const Experiment& experiment : used)
    estimate_.validation.experiments.push_back(experiment.id);
  const int own = model_->nominal().parameterCount();
  const double offset = at_.parameters.size() > own ? at_.parameters[own] : 0.0;
  const SimulationFit fit = simulationFit(model_->nominal(), at_.parameters.head(own), offset,
                                          configuration.estimation, used);
  estimate_.validation.simulation_fit_percent = fit.percent;
  estimate_.validation.simulation_fit_percent_pooled = fit.pooled;
  const std::vector<Block> blocks = makeBlocks(used);
  const int count = static_cast<int>(used.size());
  const Linearisation about =
      linearisedAtPosteriorMeans(*model_, blocks, count, threads(), at_, &estimate_.passes);
  const LinearModel& model = about.model != nullptr ? *about.model : *model_;
  const Likelihood likelihood(model, blocks, count, threads());
  const double total = likelihood.expect(likelihood.statistics(at_.parameters, false), at_).total();
  estimate_.validation.log_density_per_experiment = total / static_cast<double>(used.size());
}

ClimbOptions Identification::climbOptions(const std::string& phase, double from, double to) {
  const Configuration& configuration = estimate_.configuration;
  ClimbOptions options;
  options.constraint = configuration.error_model.constraint;
  options.max_iterations = configuration.estimation.max_iterations;
  options.tolerance = configuration.estimation.tolerance;
  options.on_iterate = [this, phase, from, to](const TracePoint& point) {
    const double share =
        1 - 1 / (1 + 0.1 * point.iteration);  // the number of iterations is not known beforehand
    return report(phase, from + (to - from) * share, point.log_likelihood);
  };
  return options;
}

bool Identification::report(const std::string& phase, double fraction, double log_likelihood) {
  fraction_ = std::max(fraction_, fraction);  // a part that is done again does not turn it back
  if (progress_ && !progress_({phase, fraction_, log_likelihood})) cancelled_ = true;
  return !cancelled_;
}

int Identification::threads() const {
  const int asked = estimate_.configuration.estimation.threads;
  if (asked != kAutomatic) return asked;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) - 1);
}

}  // namespace uncertainty_identification
