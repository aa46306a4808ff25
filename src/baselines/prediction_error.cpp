#include "uncertainty_identification/baselines/prediction_error.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "data/experiment_checks.h"
#include "estimation/initial_guess.h"
#include "estimation/plant_coordinates.h"
#include "estimation/standard_errors.h"
#include "math/information_criterion.h"
#include "math/polynomial.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/version.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

ErrorModelOptions noErrorModel() {
  ErrorModelOptions none;
  none.taps = 0;
  none.components = 1;
  return none;
}

/// theta with standard errors, from the covariances of its error (observed and robust).
std::vector<ParameterEstimate> listed(const NominalModel& nominal, const VectorXd& theta,
                                      const MatrixXd& covariance, const MatrixXd& robust) {
  const std::vector<std::string> names = nominal.names(), units = nominal.units();
  std::vector<ParameterEstimate> all;
  for (Index k = 0; k < theta.size(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    all.push_back(
        {names[at], units[at], theta[k], std::sqrt(covariance(k, k)), std::sqrt(robust(k, k))});
  }
  return all;
}

VectorXd valuesOf(const ExperimentFit& fit) {
  VectorXd theta(static_cast<Index>(fit.parameters.size()));
  for (Index k = 0; k < theta.size(); ++k)
    theta[k] = fit.parameters[static_cast<std::size_t>(k)].value;
  return theta;
}

ExperimentFit fitExperiment(const LinearModel& model, const Configuration& configuration,
                            const Experiment& experiment) {
  const std::vector<Experiment> alone{experiment};
  const std::vector<Block> blocks = makeBlocks(alone);
  const Likelihood likelihood(model, blocks, 1, 1);
  OptimisationOptions options;
  options.constraint = Constraint::free;
  options.max_iterations = std::max(1, configuration.estimation.max_iterations);
  options.tolerance = configuration.estimation.tolerance;
  const std::optional<ModelParameters> start = bestSingleComponent(
      likelihood, nominalStarts(model, configuration.nominal_model, alone), options);
  if (!start) throw DataError("the likelihood is not finite at any start");
  const Optimum optimum = maximumLikelihood(likelihood, *start, options);
  if (optimum.termination != Termination::converged) throw DataError(optimum.message);
  const Parametrisation parametrisation(model, Constraint::free, 1, MatrixXd(0, 0));
  const StandardErrors errors = standardErrors(likelihood, parametrisation, optimum.point);
  const NominalModel& nominal = model.nominal();
  const Index own = nominal.parameterCount();
  const VectorXd theta = optimum.point.parameters.head(own);
  const Polynomials p = nominal.polynomials(theta);
  const double offset = optimum.point.parameters.size() > own ? optimum.point.parameters[own] : 0.0;
  return {experiment.id,
          listed(nominal, theta, errors.covariance, errors.robust_covariance),
          p.delay,
          p.b,
          p.a,
          p.c,
          p.d,
          offset,
          optimum.point.noise_variance,
          optimum.log_likelihood};
}

void summarise(PredictionErrorFits* all) {
  const auto count = static_cast<double>(all->fits.size());
  const Index own = all->nominal->parameterCount();
  all->mean = VectorXd::Zero(own);
  for (const ExperimentFit& fit : all->fits) {
    all->mean += valuesOf(fit) / count;
    all->offset += fit.offset / count;
    all->noise_variance += fit.noise_variance / count;
  }
  all->covariance = MatrixXd::Zero(own, own);
  for (const ExperimentFit& fit : all->fits) {
    const VectorXd deviation = valuesOf(fit) - all->mean;
    all->covariance += deviation * deviation.transpose() / (count - 1);
  }
}

}  // namespace

PredictionErrorFits fitExperiments(const Configuration& configuration,
                                   std::shared_ptr<const NominalModel> nominal,
                                   const std::vector<Experiment>& experiments) {
  if (configuration.nominal_model.orders_auto) {
    throw ConfigurationError(
        "nominal_model.orders: found auto; the fits of single experiments need the orders given");
  }
  PredictionErrorFits all;
  all.nominal = std::move(nominal);
  const LinearModel model(all.nominal, ErrorBasis(noErrorModel()), configuration.estimation);
  for (const Experiment& experiment : experiments) {
    try {
      all.fits.push_back(fitExperiment(model, configuration, experiment));
    } catch (const DataError& error) {
      all.failed.push_back(
          {experiment.id, std::string("could not be fitted separately: ") + error.what()});
    }
  }
  if (all.fits.size() < 2) {
    throw DataError("fewer than two experiments can be fitted separately" +
                    (all.failed.empty()
                         ? std::string()
                         : "; '" + all.failed.front().id + "': " + all.failed.front().reason));
  }
  summarise(&all);
  return all;
}

PlantSamples plantsOf(const PredictionErrorFits& fits, double sample_time) {
  const ExperimentFit& first = fits.fits.front();
  const auto count = static_cast<Index>(fits.fits.size());
  PlantSamples plants{sample_time,
                      first.delay,
                      MatrixXd(count, first.b.size()),
                      MatrixXd(count, first.a.size()),
                      MatrixXd(count, 0),
                      noErrorModel()};
  for (Index r = 0; r < count; ++r) {
    plants.b.row(r) = fits.fits[static_cast<std::size_t>(r)].b.transpose();
    plants.a.row(r) = fits.fits[static_cast<std::size_t>(r)].a.transpose();
  }
  return plants;
}

namespace {

/// Writes the nominal model, the noise variance and the plant's covariance: those of the mean of
/// the fits.
void describeMean(const PredictionErrorFits& fits, double sample_time, Estimate* estimate) {
  const NominalModel& nominal = *fits.nominal;
  const auto count = static_cast<double>(fits.fits.size());
  const MatrixXd of_mean = fits.covariance / count;
  const Polynomials p = nominal.polynomials(fits.mean);
  estimate->nominal_model = {nominal.structure(),
                             sample_time,
                             p.delay,
                             p.b,
                             p.a,
                             p.c,
                             p.d,
                             listed(nominal, fits.mean, of_mean, of_mean),
                             of_mean};
  const MatrixXd to_plant = plantCoordinatesJacobian(nominal, fits.mean) *
                            nominal.unboundedJacobian(nominal.toUnbounded(fits.mean)).inverse();
  estimate->joint_covariance = to_plant * of_mean * to_plant.transpose();
  double squares = 0;
  for (const ExperimentFit& fit : fits.fits)
    squares += std::pow(fit.noise_variance - fits.noise_variance, 2) / (count - 1);
  const double error = std::sqrt(squares / count);
  estimate->noise_variance = {"noise_variance", "", fits.noise_variance, error, error};
}

/// Writes the likelihood at the mean of the fits, in total and for each experiment.
void evaluateMean(const PredictionErrorFits& fits, const std::vector<Experiment>& experiments,
                  Estimate* estimate) {
  const LinearModel model(fits.nominal, ErrorBasis(noErrorModel()),
                          estimate->configuration.estimation);
  const std::vector<Block> blocks = makeBlocks(experiments);
  const Likelihood likelihood(model, blocks, static_cast<int>(experiments.size()), 1);
  ModelParameters at{VectorXd::Constant(model.parameterCount(), fits.offset),
                     {{1.0}, {VectorXd(0)}, {MatrixXd(0, 0)}},
                     fits.noise_variance};
  at.parameters.head(fits.mean.size()) = fits.mean;
  const Expectation e = likelihood.expect(likelihood.statistics(at.parameters, false), at);
  for (std::size_t r = 0; r < experiments.size(); ++r) {
    const int samples = experiments[r].validSamples();
    estimate->sample_count += samples;
    estimate->experiments.push_back(
        {experiments[r].id, samples, {1.0}, VectorXd(0), e.log_likelihood[static_cast<Index>(r)]});
  }
  estimate->error_model.mixture = at.mixture;
  estimate->log_likelihood = e.total();
  estimate->bic = bic(e.total(), model.parameterCount() + 1, 0,
                      static_cast<double>(estimate->sample_count), estimate->experiment_count);
}

}  // namespace

Estimate meanEstimate(const Configuration& configuration, const PredictionErrorFits& fits,
                      const std::vector<Experiment>& experiments) {
  if (!fits.nominal->admissible(fits.mean)) {
    throw DataError(
        "the mean of the experiments' fits is not an admissible model: A, C or D has roots "
        "outside the unit circle");
  }
  Estimate estimate;
  estimate.configuration = configuration;
  estimate.configuration.error_model = noErrorModel();
  estimate.version = version();
  estimate.data_fingerprint = dataFingerprint(experiments);
  estimate.experiment_count = static_cast<int>(experiments.size());
  estimate.error_model.options = estimate.configuration.error_model;
  const bool at_input = configuration.estimation.offset_side == OffsetSide::input;
  (at_input ? estimate.offset_u : estimate.offset_y) = fits.offset;
  describeMean(fits, experiments.front().sample_time, &estimate);
  evaluateMean(fits, experiments, &estimate);
  estimate.rejected = fits.failed;
  estimate.termination = Termination::converged;
  estimate.message =
      "mean of " + std::to_string(fits.fits.size()) + " separate fits, one per experiment";
  return estimate;
}

Bands magnitudeBands(const PlantSamples& plants, const VectorXd& omega,
                     const std::vector<double>& levels) {
  constexpr float kResolution = 1e-6F;
  std::vector<double> told;
  for (double level : levels) {
    if ((1 - level) / 2 * plants.count() >= 1) told.push_back(level);
  }
  if (told.empty()) return {};
  const ComplexResponses all = frequencyResponses(plants, omega);
  BandBuilder builder(told, plants.count(), omega.size(), Sides::two, kResolution);
  for (Index k = 0; k < omega.size(); ++k) {
    const Eigen::ArrayXd squared =
        all.real.col(k).array().square() + all.imaginary.col(k).array().square();
    builder.add(squared.sqrt().cast<float>());
  }
  return builder.bands();
}

}  // namespace uncertainty_identification
