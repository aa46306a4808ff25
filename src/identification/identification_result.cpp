#include <algorithm>
#include <cmath>
#include <limits>

#include "effects/extended_model.h"
#include "estimation/plant_coordinates.h"
#include "estimation/residual_tests.h"
#include "estimation/selection.h"
#include "estimation/standard_errors.h"
#include "identification/identification.h"
#include "model/sensitivity.h"

namespace uncertainty_identification {

using Eigen::Index;
using Eigen::VectorXd;

void Identification::describe() {
  const Configuration& configuration = estimate_.configuration;
  const NominalModel& nominal = model_->nominal();
  const Polynomials p = nominal.polynomials(at_.parameters.head(nominal.parameterCount()));
  NominalModelEstimate& go = estimate_.nominal_model;
  go.structure = nominal.structure();
  go.sample_time = sample_time_;
  go.delay = p.delay;
  go.b = p.b;
  go.a = p.a;
  go.c = p.c;
  go.d = p.d;
  estimate_.error_model.options = configuration.error_model;
  estimate_.error_model.T = model_->basis().T();
  estimate_.error_model.mixture = at_.mixture;
  describeExperiments();
  describeParameters();
  if (estimate_.termination != Termination::cancelled) {
    const int noise = static_cast<int>(p.c.size() + p.d.size());
    estimate_.residual_tests = residualTests(*model_, blocks_, at_.parameters, noise,
                                             std::max(0, nominal.parameterCount() - noise));
  }
  const int mixture = mixtureParameters(configuration.error_model.constraint, model_->regressors(),
                                        at_.mixture.components());
  const int parameters = model_->parameterCount() + static_cast<int>(plant_parameters_.size()) + 1;
  estimate_.bic = bic(estimate_.log_likelihood, parameters, mixture,
                      static_cast<double>(estimate_.sample_count), estimate_.experiment_count);
  estimate_.passes += likelihood_->passes();
  const bool wanting = estimate_.termination == Termination::stalled ||
                       estimate_.termination == Termination::iteration_limit;
  if (wanting)
    estimate_.warnings.push_back("the estimation did not converge: " + estimate_.message);
}

void Identification::describeExperiments() {
  const Expectation e = likelihood_->expect(likelihood_->statistics(at_.parameters, false), at_);
  const LatentMoments moments = latentMoments(e);
  for (Index r = 0; r < e.log_likelihood.size(); ++r) {
    const Experiment& experiment = experiments_[static_cast<std::size_t>(r)];
    ExperimentEstimate of_experiment;
    of_experiment.id = experiment.id;
    of_experiment.samples = experiment.validSamples();
    const VectorXd responsibilities = e.responsibilities.col(r);
    of_experiment.responsibilities.assign(responsibilities.data(),
                                          responsibilities.data() + responsibilities.size());
    of_experiment.error_mean = moments.means.col(r);
    of_experiment.log_likelihood = e.log_likelihood[r];
    estimate_.experiments.push_back(std::move(of_experiment));
  }
}

void Identification::describeParameters() {
  const Parametrisation parametrisation(
      *model_, estimate_.configuration.error_model.constraint, at_.mixture.components(),
      0.0 * at_.mixture.covariance());  // the floor is no part of the model
  const VectorXd values = parametrisation.natural(at_);
  const std::vector<std::string> names = parametrisation.naturalNames();
  const std::vector<std::string> units = model_->nominal().units();
  const Index own = model_->nominal().parameterCount(), last = values.size() - 1;
  Eigen::MatrixXd nothing =
      Eigen::MatrixXd::Constant(last + 1, last + 1, std::numeric_limits<double>::quiet_NaN());
  StandardErrors errors{nothing, nothing, {}, {}, {}};
  if (estimate_.termination != Termination::cancelled &&
      report("standard errors", 0.95, estimate_.log_likelihood)) {
    errors = standardErrors(*likelihood_, parametrisation, at_);
    estimate_.joint_covariance = jointCovariance(errors.coordinate_covariance);
  }
  for (const std::string& sentence : errors.singular) estimate_.warnings.push_back(sentence);
  const auto describe = [&](Index k) {
    const auto at = static_cast<std::size_t>(k);
    return ParameterEstimate{names[at], k < own ? units[at] : "", values[k],
                             std::sqrt(errors.covariance(k, k)),
                             std::sqrt(errors.robust_covariance(k, k))};
  };
  NominalModelEstimate& go = estimate_.nominal_model;
  go.parameters = plant_parameters_;  // none, unless Go was fitted before the rest
  for (Index k = 0; k < own; ++k) go.parameters.push_back(describe(k));
  const Index before = plant_covariance_.rows();
  go.covariance = Eigen::MatrixXd::Zero(before + own, before + own);
  go.covariance.topLeftCorner(before, before) = plant_covariance_;
  go.covariance.bottomRightCorner(own, own) = errors.covariance.topLeftCorner(own, own);
  for (Index k = own; k < model_->parameterCount(); ++k) {
    if (const auto dot = names[static_cast<std::size_t>(k)].find('.'); dot != std::string::npos) {
      describeEffect(describe(k), dot);
      continue;
    }
    (names[static_cast<std::size_t>(k)] == "offset_u" ? estimate_.offset_u : estimate_.offset_y) =
        values[k];
  }
  if (model_->regressors() > 0) {
    for (Index k = model_->parameterCount(); k < last; ++k)
      estimate_.error_model.parameters.push_back(describe(k));
  }
  estimate_.noise_variance = describe(last);
}

/// A parameter "effect.parameter" of an effect.
void Identification::describeEffect(ParameterEstimate parameter, std::size_t dot) {
  const std::string effect = parameter.name.substr(0, dot);
  parameter.name = parameter.name.substr(dot + 1);
  const auto& options = estimate_.configuration.effects;
  const auto& effects = dynamic_cast<const ExtendedModel&>(*model_).effects();
  for (std::size_t k = 0; k < options.size(); ++k) {
    if (options[k].name != effect) continue;
    while (estimate_.effects.size() <= k) {
      const EffectOptions& next = options[estimate_.effects.size()];
      estimate_.effects.push_back({next.name, next.variant, {}});
    }
    for (const EffectParameter& of : effects[k]->description().parameters) {
      if (of.name != parameter.name) continue;
      parameter.unit = of.unit;
      if (!of.log_variance) continue;
      parameter.value = told(of, parameter.value, at_.noise_variance);
      parameter.standard_error *= parameter.value / 2;
      parameter.robust_standard_error *= parameter.value / 2;
    }
    estimate_.effects[k].parameters.push_back(std::move(parameter));
    return;
  }
}

/// From the coordinates of the climb to those of Estimate::joint_covariance.
Eigen::MatrixXd Identification::jointCovariance(
    const Eigen::MatrixXd& coordinate_covariance) const {
  const NominalModel& nominal = model_->nominal();
  const Index own = nominal.parameterCount(), parameters = model_->parameterCount();
  const Index mixture =
      model_->regressors() > 0 ? coordinate_covariance.rows() - parameters - 1 : 0;
  const bool varies = variesParameters(estimate_.error_model.options.basis) && mixture > 0;
  const Eigen::MatrixXd to_plant =
      varies ? Eigen::MatrixXd::Identity(own, own)
             : plantCoordinatesJacobian(nominal, at_.parameters.head(own));
  const Index plant = to_plant.rows();
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(plant + mixture, coordinate_covariance.rows());
  J.topLeftCorner(plant, own) = to_plant;
  J.block(plant, parameters, mixture, mixture).setIdentity();
  Eigen::MatrixXd joint = J * coordinate_covariance * J.transpose();
  if (plant_.has_value()) joint.topLeftCorner(plant, plant) = plant_coordinate_covariance_;
  return joint;
}

}  // namespace uncertainty_identification
