#pragma once

#include <string>
#include <variant>

#include "uncertainty_identification/io/tree_values.h"
#include "uncertainty_identification/simulation/effects_truth.h"

/// Reads and writes the parts of a truth by the description that each part gives of itself.
/// config/truth_reference.yaml explains their keys.
namespace uncertainty_identification {

/// Any struct with a function fields().
template <class Archive, class Part>
auto bind(Archive& archive, Part& part) -> decltype(part.fields(), void()) {
  for (const Field& field : part.fields())
    std::visit([&](auto* value) { archive(field.key, *value); }, field.value);
}

template <class Archive>
void bind(Archive& archive, EffectsTruth& effects) {
  effects.forEach(
      [&archive](const std::string& name, auto& effect) { archive(name, whenPresent(effect)); });
}

}  // namespace uncertainty_identification
