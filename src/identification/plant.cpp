#include <cmath>

#include "estimation/initial_guess.h"
#include "estimation/plant_coordinates.h"
#include "identification/steps.h"

/// Go fitted to its free simulation (nominal_model.fit: simulation), before H and the error model.
namespace uncertainty_identification {

using Eigen::Index;

namespace {

/// Go with white noise and no error model: its residual is the error of the simulation.
LinearModel simulationModel(const Problem& problem) {
  NominalModelOptions options = problem.configuration.nominal_model;
  options.structure = Structure::output_error;
  ErrorModelOptions none;
  none.taps = 0;
  return LinearModel(makeNominalModel(options, problem.data.sampleTime()), ErrorBasis(none),
                     problem.configuration.estimation);
}

}  // namespace

FittedPlant plantOf(const LinearModel& model, const ModelParameters& point) {
  const Index own = model.nominal().parameterCount();
  return {model.nominal().polynomials(point.parameters.head(own)),
          point.parameters.size() > own ? point.parameters[own] : 0.0, point};
}

double offsetOf(const Problem& problem, const LinearModel& model, const ModelParameters& point) {
  return problem.plant ? problem.plant->offset : plantOf(model, point).offset;
}

std::optional<FittedPlant> fitPlant(const Problem& problem, Journal* journal) {
  const Configuration& configuration = problem.configuration;
  if (configuration.nominal_model.fit != PlantFit::simulation) return {};
  const LinearModel model = simulationModel(problem);
  const std::unique_ptr<Likelihood> likelihood = likelihoodOf(problem, model);
  const std::vector<Eigen::VectorXd> starts =
      hasGivenParameters(problem)
          ? std::vector<Eigen::VectorXd>{givenParameters(problem, model)}
          : nominalStarts(model, NominalModelOptions(), problem.data.experiments);
  const OptimisationOptions options =
      optimisationOptions(configuration, Phase::plant, &journal->progress);
  const ModelParameters start =
      requireStart(bestSingleComponent(*likelihood, starts, options), model);
  const Optimum optimum = maximumLikelihood(*likelihood, start, options);
  journal->passes += likelihood->passes();
  return plantOf(model, optimum.point);
}

FittedPlant describePlant(const Problem& problem, Journal* journal) {
  FittedPlant plant = *problem.plant;
  const LinearModel model = simulationModel(problem);
  const std::unique_ptr<Likelihood> likelihood = likelihoodOf(problem, model);
  const Index own = model.nominal().parameterCount();
  const Parametrisation parametrisation(model, Constraint::free, 1, Eigen::MatrixXd(0, 0));
  const StandardErrors errors = errorsOfFit(*likelihood, parametrisation, plant.point);
  journal->warnings.insert(journal->warnings.end(), errors.singular.begin(), errors.singular.end());
  const std::vector<std::string> names = model.names();
  for (Index k = 0; k < own; ++k) {
    plant.parameters.push_back({names[static_cast<std::size_t>(k)], "", plant.point.parameters[k],
                                std::sqrt(errors.covariance(k, k)),
                                std::sqrt(errors.robust_covariance(k, k))});
  }
  plant.covariance = errors.covariance.topLeftCorner(own, own);
  // The residual of a simulation is not white, so only the sandwich form is valid.
  // Singular directions are NaN in the robust covariance; where it is unknown, all of it is.
  const Eigen::MatrixXd& covariance = errors.robust_covariance.array().isFinite().any()
                                          ? errors.robust_coordinate_covariance
                                          : errors.coordinate_covariance;
  const Eigen::MatrixXd J =
      plantCoordinatesJacobian(model.nominal(), plant.point.parameters.head(own));
  plant.coordinate_covariance = J * covariance.topLeftCorner(own, own) * J.transpose();
  journal->passes += likelihood->passes();
  return plant;
}

}  // namespace uncertainty_identification
