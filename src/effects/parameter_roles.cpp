#include <algorithm>
#include <cmath>

#include "effects/extended_model.h"

/// What the parameters of an extended model are called and how results report them.
namespace uncertainty_identification {

using Eigen::VectorXd;

double toReported(const EffectParameter& parameter, double value, double noise_variance) {
  return parameter.log_variance ? std::sqrt(noise_variance) * std::exp(0.5 * value) : value;
}

double fromReported(const EffectParameter& parameter, double reported, double noise_variance) {
  if (!parameter.log_variance) return reported;
  return std::clamp(std::log(reported * reported / noise_variance), parameter.lower,
                    parameter.upper);
}

std::vector<ParameterRole> ExtendedModel::roles() const {
  std::vector<ParameterRole> all = LinearModel::roles();
  for (std::size_t k = 0; k < effects_.size(); ++k) {
    const EffectDescription& effect = effects_[k]->description();
    for (const EffectParameter& parameter : effect.parameters)
      all.push_back({ParameterRole::Of::effect, parameter.name, parameter.unit, k, effect.name,
                     effect.variant});
  }
  return all;
}

/// Null for a parameter of the linear model itself.
const EffectParameter* ExtendedModel::effectParameter(std::size_t k) const {
  for (std::size_t i = 0; i < effects_.size(); ++i) {
    const auto first = static_cast<std::size_t>(offsets_[i]);
    const auto& parameters = effects_[i]->description().parameters;
    if (k >= first && k < first + parameters.size()) return &parameters[k - first];
  }
  return nullptr;
}

ReportedValue ExtendedModel::reported(std::size_t k, double value, double noise_variance) const {
  const EffectParameter* parameter = effectParameter(k);
  if (parameter == nullptr || !parameter->log_variance) return {value, 1};
  const double deviation = toReported(*parameter, value, noise_variance);
  return {deviation, deviation / 2};
}

double ExtendedModel::fromReported(std::size_t k, double reported, double noise_variance) const {
  const EffectParameter* parameter = effectParameter(k);
  if (parameter == nullptr) return reported;
  return uncertainty_identification::fromReported(*parameter, reported, noise_variance);
}

VectorXd ExtendedModel::withStartingValues(const VectorXd& start,
                                           const std::vector<EffectOptions>& effects) const {
  const VectorXd psi = startingValues(effects_, effects);
  VectorXd all(start.size() + psi.size());
  all << start, psi;
  return all;
}

}  // namespace uncertainty_identification
