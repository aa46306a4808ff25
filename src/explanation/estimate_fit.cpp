#include "explanation/estimate_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "data/unmeasured_start.h"
#include "identification/steps.h"
#include "model/fixed_plant.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {

using Eigen::Index;
using Eigen::VectorXd;

std::vector<Experiment> usedBy(const Estimate& estimate, std::vector<Experiment> all) {
  std::vector<Experiment> used;
  for (Experiment& experiment : all) {
    const std::size_t next = used.size();
    if (next == estimate.experiments.size()) break;
    if (experiment.id == estimate.experiments[next].id) used.push_back(std::move(experiment));
  }
  std::vector<std::string> told_by_identify;
  return mayStartAnywhere(estimate.configuration.estimation, used)
             ? fromFirstMeasured(std::move(used), &told_by_identify)
             : used;
}

namespace {

bool isPlantHeld(const Estimate& estimate) {
  return estimate.configuration.nominal_model.fit == PlantFit::simulation;
}

/// The model with all poles, and the zeros of its noise, a millionth nearer to the origin.
Polynomials withRootsPulledIn(Polynomials p) {
  constexpr double kInwards = 1 - 1e-6;
  for (VectorXd* polynomial : {&p.a, &p.c, &p.d}) {
    double factor = 1;
    for (Eigen::Index k = 0; k < polynomial->size(); ++k) (*polynomial)[k] *= factor *= kInwards;
  }
  return p;
}

/// Sets the value of the parameter of that name, which is added where there is none.
void setValue(const std::string& name, double value, std::vector<ParameterEstimate>* parameters) {
  const auto known = std::find_if(parameters->begin(), parameters->end(),
                                  [&](const ParameterEstimate& one) { return one.name == name; });
  if (known == parameters->end())
    parameters->push_back({name, "", value, 0, 0});
  else
    known->value = value;
}

/// The model of the estimate with these polynomials, or the parameters as they were estimated.
Fit fitWith(const Polynomials& p, bool as_estimated, const Estimate& estimate, const FitData& data,
            const DataSummary& summary) {
  const NominalModelOptions& options = estimate.configuration.nominal_model;
  const auto nominal = isPlantHeld(estimate)
                           ? fixPlant(p, static_cast<int>(p.c.size()), static_cast<int>(p.d.size()))
                           : makeNominalModel(options, estimate.nominal_model.sample_time);
  const ErrorBasis basis(estimate.configuration.error_model);
  const auto model = std::make_shared<const ExtendedModel>(
      nominal, basis, estimate.configuration.estimation, Effects(), summary, data.count());
  ModelParameters at{VectorXd::Zero(model->LinearModel::parameterCount()),
                     estimate.error_model.mixture, estimate.noise_variance.value};
  const Index own = nominal->parameterCount();
  const std::vector<ParameterEstimate>& given = estimate.nominal_model.parameters;
  if (as_estimated && static_cast<Index>(given.size()) == own) {
    for (Index k = 0; k < own; ++k) at.parameters[k] = given[static_cast<std::size_t>(k)].value;
  } else {
    at.parameters.head(own) = nominal->fromPolynomials(p);
  }
  if (at.parameters.size() > own)
    at.parameters[own] = options.structure == Structure::continuous || estimate.offset_u == 0
                             ? estimate.offset_y
                             : estimate.offset_u;
  return evaluated(model, at, data);
}

}  // namespace

Fit fitOf(const Estimate& estimate, const FitData& data, const DataSummary& summary) {
  Polynomials p;
  p.delay = estimate.nominal_model.delay;
  p.b = estimate.nominal_model.b;
  p.a = estimate.nominal_model.a;
  p.c = estimate.nominal_model.c;
  p.d = estimate.nominal_model.d;
  Fit fit = fitWith(p, true, estimate, data, summary);
  const bool is_continuous =
      estimate.configuration.nominal_model.structure == Structure::continuous;
  if (std::isfinite(fit.log_likelihood) || is_continuous) return fit;
  // Roots at the very edge of stability may lie beyond it by the rounding of the coefficients.
  return fitWith(withRootsPulledIn(p), false, estimate, data, summary);
}

Estimate estimateOf(const Fit& fit, const FitData& data, const Estimate& base, int iterations) {
  Estimate start = base;
  start.configuration.error_model.components = fit.at.mixture.components();
  start.error_model.mixture = fit.at.mixture;
  start.noise_variance.value = fit.at.noise_variance;
  const NominalModel& nominal = fit.model->nominal();
  const std::vector<std::string> names = nominal.names();
  if (!isPlantHeld(base)) start.nominal_model.parameters.clear();
  for (std::size_t k = 0; k < names.size(); ++k)
    setValue(names[k], fit.at.parameters[static_cast<Index>(k)], &start.nominal_model.parameters);
  const auto own = static_cast<Index>(names.size());
  const Index offsets = fit.at.parameters.size() - fit.model->effectParameterCount() - own;
  if (offsets > 0) start.offset_u = start.offset_y = fit.at.parameters[own];
  start.configuration.effects.clear();
  start.effects.clear();
  for (std::size_t k = 0; k < fit.model->effects().size(); ++k) {
    const EffectDescription& description = fit.model->effects()[k]->description();
    const VectorXd psi = fit.model->psi(fit.at.parameters, k);
    EffectOptions options{description.name, description.variant, {}};
    EffectEstimate estimate{description.name, description.variant, {}};
    for (std::size_t i = 0; i < description.parameters.size(); ++i) {
      const EffectParameter& parameter = description.parameters[i];
      options.parameters[parameter.name] = psi[static_cast<Index>(i)];
      estimate.parameters.push_back(
          {parameter.name, parameter.unit,
           toReported(parameter, psi[static_cast<Index>(i)], fit.at.noise_variance), 0, 0});
    }
    start.configuration.effects.push_back(std::move(options));
    start.effects.push_back(std::move(estimate));
  }
  int& limit = start.configuration.estimation.max_iterations;
  const int asked = limit;
  limit = std::min(asked, iterations);
  Estimate estimate = Identifier(start.configuration).reidentify(start, data.experiments());
  estimate.configuration.estimation.max_iterations = asked;
  return estimate;
}

}  // namespace uncertainty_identification
