#include <algorithm>
#include <cmath>

#include "configuration/require.h"
#include "effects/extended_model.h"
#include "model/sensitivity.h"
#include "uncertainty_identification/effects/catalogue.h"
#include "uncertainty_identification/enum_names.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {

using Eigen::Index;
using Eigen::VectorXd;

std::vector<std::string> plantParameters(const NominalModel& nominal, const VectorXd& theta) {
  const Polynomials p = nominal.polynomials(theta);
  const Eigen::MatrixXd jacobian = nominal.jacobian(theta);
  const std::vector<std::string> names = nominal.names();
  std::vector<std::string> all;
  for (Index k = 0; k < jacobian.cols(); ++k) {
    if (jacobian.col(k).head(p.b.size() + p.a.size()).isZero(0)) break;
    all.push_back(names[static_cast<std::size_t>(k)]);
  }
  return all;
}

std::unique_ptr<ExtendedModel> makeExtendedModel(std::shared_ptr<const NominalModel> nominal,
                                                 const Configuration& configuration,
                                                 const std::vector<Experiment>& experiments) {
  require(!variesParameters(configuration.error_model.basis), "error_model.basis",
          nameOf(configuration.error_model.basis), "fir, laguerre or kautz together with effects");
  const ErrorBasis basis(configuration.error_model);
  DataSummary summary = summarise(experiments);
  summary.regressors = basis.dimension();
  summary.plant_parameters = plantParameters(
      *nominal, nominal->fromUnbounded(VectorXd::Constant(nominal->parameterCount(), 0.1)));
  const Effects all = catalogue(summary);
  Effects effects;
  for (const EffectOptions& options : configuration.effects) {
    effects.push_back(findEffect(all, options.name, options.variant));
    require(effects.back()->stage() != Stage::data, "effects", options.name,
            "effects that extend the model; this one is found in the data themselves");
  }
  return std::make_unique<ExtendedModel>(std::move(nominal), basis, configuration.estimation,
                                         std::move(effects), summary,
                                         static_cast<int>(experiments.size()));
}

VectorXd startingValues(const Effects& effects, const std::vector<EffectOptions>& options) {
  std::vector<double> values;
  for (std::size_t k = 0; k < effects.size(); ++k) {
    const EffectDescription& description = effects[k]->description();
    std::size_t given = 0;
    for (std::size_t i = 0; i < description.parameters.size(); ++i) {
      const auto found = options[k].parameters.find(description.parameters[i].name);
      given += found != options[k].parameters.end() ? 1 : 0;
      if (found == options[k].parameters.end() && description.starts.empty())
        throw ConfigurationError("effects: " + effects[k]->label() + " has no value to begin its " +
                                 description.parameters[i].name + " with: state one");
      values.push_back(found != options[k].parameters.end()
                           ? found->second
                           : description.starts.front()[static_cast<Index>(i)]);
    }
    if (given == options[k].parameters.size()) continue;
    std::string names;
    for (const EffectParameter& parameter : description.parameters)
      names += (names.empty() ? "" : ", ") + parameter.name;
    throw ConfigurationError("effects: " + description.name +
                             ": found a parameter it lacks; it has " + names);
  }
  return Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size()));
}

}  // namespace uncertainty_identification
