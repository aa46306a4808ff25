#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

/// The words for an enumeration's values in configurations and results, in the order in which the
/// values are declared.
template <class Enum>
using EnumNames = std::vector<std::pair<Enum, std::string>>;

const EnumNames<Structure>& enumNames(Structure);
const EnumNames<Focus>& enumNames(Focus);
const EnumNames<PlantFit>& enumNames(PlantFit);
const EnumNames<BasisKind>& enumNames(BasisKind);
const EnumNames<Constraint>& enumNames(Constraint);
const EnumNames<Algorithm>& enumNames(Algorithm);
const EnumNames<InitialState>& enumNames(InitialState);
const EnumNames<NoiseStart>& enumNames(NoiseStart);
const EnumNames<Offsets>& enumNames(Offsets);
const EnumNames<OffsetSide>& enumNames(OffsetSide);
const EnumNames<InputResampling>& enumNames(InputResampling);
const EnumNames<OutputResampling>& enumNames(OutputResampling);
const EnumNames<TimeUnit>& enumNames(TimeUnit);
const EnumNames<ExperimentMode>& enumNames(ExperimentMode);
const EnumNames<TransferDomain>& enumNames(TransferDomain);

/// The word for a value, e.g. "box_jenkins". Throws std::invalid_argument for a value that is not
/// in the list.
template <class Enum>
std::string nameOf(Enum value) {
  for (const auto& [candidate, name] : enumNames(value)) {
    if (candidate == value) return name;
  }
  throw std::invalid_argument("a value outside its enumeration");
}

}  // namespace uncertainty_identification
