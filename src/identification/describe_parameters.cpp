#include <cmath>
#include <limits>

#include "estimation/plant_coordinates.h"
#include "identification/steps.h"
#include "model/sensitivity.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Transforms the covariance from the coordinates of the optimisation to those of
/// Estimate::joint_covariance.
MatrixXd jointCovariance(const Problem& problem, const FittedModel& fitted,
                         const MatrixXd& coordinate_covariance) {
  const LinearModel& model = *fitted.model;
  const NominalModel& nominal = model.nominal();
  const Index own = nominal.parameterCount(), parameters = model.parameterCount();
  const Index mixture = model.regressors() > 0 ? coordinate_covariance.rows() - parameters - 1 : 0;
  const bool varies = variesParameters(problem.configuration.error_model.basis) && mixture > 0;
  const MatrixXd to_plant =
      varies ? MatrixXd::Identity(own, own)
             : plantCoordinatesJacobian(nominal, fitted.optimum.point.parameters.head(own));
  const Index plant = to_plant.rows();
  MatrixXd J = MatrixXd::Zero(plant + mixture, coordinate_covariance.rows());
  J.topLeftCorner(plant, own) = to_plant;
  J.block(plant, parameters, mixture, mixture).setIdentity();
  MatrixXd joint = J * coordinate_covariance * J.transpose();
  if (problem.plant) joint.topLeftCorner(plant, plant) = problem.plant->coordinate_covariance;
  return joint;
}

/// The covariance in the coordinates of the optimisation: the robust one where it is known and
/// disagrees, so that the bounds contain the scatter of the experiments that the model lacks.
const MatrixXd& wider(const StandardErrors& errors) {
  constexpr double kAgree = 1.5;  // ratio of standard errors
  const VectorXd plain = errors.coordinate_covariance.diagonal();
  const VectorXd robust = errors.robust_coordinate_covariance.diagonal();
  const bool known = errors.robust_covariance.allFinite();
  const bool larger = (robust.array() > kAgree * kAgree * plain.array()).any();
  return known && larger ? errors.robust_coordinate_covariance : errors.coordinate_covariance;
}

/// Standard errors in natural coordinates, and the entries of the estimate that depend on them.
StandardErrors errorsOf(const Problem& problem, const FittedModel& fitted,
                        const Parametrisation& parametrisation, Journal* journal,
                        Estimate* estimate) {
  journal->progress.report(Phase::errors, 0, fitted.optimum.log_likelihood);
  StandardErrors errors = errorsOfFit(*fitted.likelihood, parametrisation, fitted.optimum.point);
  estimate->joint_covariance = jointCovariance(problem, fitted, wider(errors));
  journal->warnings.insert(journal->warnings.end(), errors.singular.begin(), errors.singular.end());
  return errors;
}

/// The covariance of all model parameters: if Go was fitted to its simulation, the covariance from
/// that fit comes first.
void setCovariance(const std::optional<FittedPlant>& plant, const MatrixXd& own,
                   NominalModelEstimate* go) {
  const Index before = plant ? plant->covariance.rows() : 0;
  go->covariance = MatrixXd::Zero(before + own.rows(), before + own.rows());
  if (plant) go->covariance.topLeftCorner(before, before) = plant->covariance;
  go->covariance.bottomRightCorner(own.rows(), own.rows()) = own;
}

/// Adds a parameter to the estimate of the effect that it belongs to.
void addEffectParameter(ParameterEstimate parameter, const ParameterRole& role,
                        const ReportedValue& reported, Estimate* estimate) {
  parameter.name = role.name;
  parameter.value = reported.value;
  parameter.standard_error *= reported.derivative;
  parameter.robust_standard_error *= reported.derivative;
  while (estimate->effects.size() <= role.effect) {
    const EffectOptions& next = estimate->configuration.effects[estimate->effects.size()];
    estimate->effects.push_back({next.name, next.variant, {}});
  }
  estimate->effects[role.effect].parameters.push_back(std::move(parameter));
}

/// Adds a parameter of the model to the part of the estimate that its role names.
void addParameter(const ParameterEstimate& parameter, const ParameterRole& role,
                  const ReportedValue& reported, Estimate* estimate) {
  switch (role.of) {
    case ParameterRole::Of::nominal_model:
      estimate->nominal_model.parameters.push_back(parameter);
      return;
    case ParameterRole::Of::input_offset:
      estimate->offset_u = parameter.value;
      return;
    case ParameterRole::Of::output_offset:
      estimate->offset_y = parameter.value;
      return;
    case ParameterRole::Of::effect:
      addEffectParameter(parameter, role, reported, estimate);
  }
}

}  // namespace

void describeParameters(const Problem& problem, const FittedModel& fitted, Journal* journal,
                        Estimate* estimate) {
  const LinearModel& model = *fitted.model;
  const ModelParameters& point = fitted.optimum.point;
  const Parametrisation parametrisation(
      model, problem.configuration.error_model.constraint, point.mixture.components(),
      0.0 * point.mixture.covariance());  // the floor is no part of the model
  const VectorXd values = parametrisation.natural(point);
  const std::vector<std::string> names = parametrisation.naturalNames();
  const std::vector<ParameterRole> roles = model.roles();
  const StandardErrors errors = errorsOf(problem, fitted, parametrisation, journal, estimate);
  const auto described = [&](std::size_t k, const std::string& unit) {
    const auto at = static_cast<Index>(k);
    return ParameterEstimate{names[k], unit, values[at], std::sqrt(errors.covariance(at, at)),
                             std::sqrt(errors.robust_covariance(at, at))};
  };
  if (problem.plant) estimate->nominal_model.parameters = problem.plant->parameters;
  const Index own = model.nominal().parameterCount();
  setCovariance(problem.plant, errors.covariance.topLeftCorner(own, own), &estimate->nominal_model);
  for (std::size_t k = 0; k < roles.size(); ++k) {
    addParameter(described(k, roles[k].unit), roles[k],
                 model.reported(k, values[static_cast<Index>(k)], point.noise_variance), estimate);
  }
  const auto last = names.size() - 1;
  for (std::size_t k = roles.size(); model.regressors() > 0 && k < last; ++k)
    estimate->error_model.parameters.push_back(described(k, ""));
  estimate->noise_variance = described(last, "");
}

}  // namespace uncertainty_identification
