#include <cmath>

#include "fmu/model_description.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

bool isOfCausality(const FmuVariable& variable, const std::string& causality) {
  if (causality != "parameter") return variable.causality == causality;
  return variable.causality != "input" && std::isfinite(variable.start);
}

}  // namespace

const FmuVariable& ModelDescription::variable(const std::string& key, const std::string& name,
                                              const std::string& causality) const {
  constexpr std::size_t kMostTold = 20;
  std::string names;
  std::size_t count = 0;
  for (const FmuVariable& each : variables) {
    if (!isOfCausality(each, causality)) continue;
    if (each.name == name) return each;
    const bool is_told = causality != "parameter" || each.causality == "parameter";
    if (is_told && ++count <= kMostTold) names += (count > 1 ? ", " : "") + each.name;
  }
  if (count > kMostTold) names += " and " + std::to_string(count - kMostTold) + " more";
  throw ConfigurationError(key + ": found '" + name + "'; " +
                           (count > 0 ? "allowed, by the FMU's modelDescription.xml: " + names
                                      : "the FMU has no real " + causality));
}

}  // namespace uncertainty_identification
