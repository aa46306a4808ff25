#include "io/truth_binding.h"

#include "io/archive.h"
#include "io/configuration_binding.h"
#include "simulation/field.h"

namespace uncertainty_identification {

/// Reads or writes any part of a truth that describes itself by a function fields().
template <class Part>
auto bind(Archive& archive, Part& part) -> decltype(part.fields(), void()) {
  for (const Field& field : part.fields())
    std::visit([&](auto* value) { archive(field.key, *value); }, field.value);
}

void bind(Archive& archive, EffectsTruth& effects) {
  effects.forEach(
      [&archive](const std::string& name, auto& effect) { archive(name, whenPresent(effect)); });
}

void bind(Archive& archive, ErrorModelTruth& error_model) {
  bindBasis(archive, error_model.basis);
  bindMixture(archive, error_model.mixture);
}

void bind(Archive& archive, Truth& truth) {
  archive("sample_time", truth.sample_time);
  archive.section("experiments", [&truth](Archive& section) {
    section("count", truth.experiments);
    section("samples", oneOrMany(truth.samples));
  });
  archive("input", truth.input);
  archive("plant", truth.plant);
  archive("error_model", truth.error_model);
  archive("sensor", truth.sensor);
  archive("noise", truth.noise);
  archive("covariates", truth.covariates);
  archive("effects", truth.effects);
}

void bind(Archive& archive, EffectDraws& draws) {
  archive("parameter_deviation", draws.parameter_deviation);
  archive("initial_state", draws.initial_state);
  archive("bias", draws.bias);
  archive("drift", draws.drift);
  archive("hum_phase", draws.hum_phase);
  archive("clock_shift", draws.clock_shift);
}

}  // namespace uncertainty_identification
