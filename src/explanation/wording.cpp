#include "explanation/wording.h"

#include <map>

namespace uncertainty_identification {

std::string named(const Effect& effect) {
  return effect.description().meaning + " (" + effect.label() + ")";
}

std::string groupOf(const std::string& name) {
  static const std::map<std::string, std::string> kGroups{{"act", "actuator"},
                                                          {"plant", "plant"},
                                                          {"sens", "sensor"},
                                                          {"noise", "noise"},
                                                          {"exp", "experiment"}};
  const std::string prefix = name.substr(0, name.find('_'));
  const auto group = kGroups.find(prefix);
  return group == kGroups.end() ? prefix : group->second;
}

std::string orderText(const Estimate& estimate) {
  const NominalModelOptions& of = estimate.configuration.nominal_model;
  const auto text = [](const char* name, int value) {
    return std::string(name) + "=" + std::to_string(value);
  };
  return text("nb", of.nb) + text(" na", of.na) + text(" nc", of.nc) + text(" nd", of.nd) +
         text(" delay", of.delay);
}

}  // namespace uncertainty_identification
