#include "fmu/model_description.h"

#include <tinyxml2.h>

#include <cstdlib>
#include <limits>
#include <map>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using tinyxml2::XMLElement;

std::string attribute(const XMLElement* element, const char* name) {
  const char* text = element ? element->Attribute(name) : nullptr;
  return text ? text : "";
}

const XMLElement* child(const XMLElement* element, const char* name) {
  return element ? element->FirstChildElement(name) : nullptr;
}

template <class Use>
void forEachChild(const XMLElement* element, const Use& use) {
  for (element = element ? element->FirstChildElement() : nullptr; element;
       element = element->NextSiblingElement())
    use(*element);
}

/// Units of the types that variables are declared with.
std::map<std::string, std::string> typeUnits(const XMLElement* root) {
  std::map<std::string, std::string> units;
  forEachChild(child(root, "TypeDefinitions"), [&](const XMLElement& type) {
    const XMLElement* real = child(&type, "Real");  // FMI 2; in FMI 3 the type itself
    units[attribute(&type, "name")] = attribute(real ? real : &type, "unit");
  });
  return units;
}

FmuVariable variableOf(const XMLElement& element, const XMLElement& numbers,
                       const std::map<std::string, std::string>& units) {
  FmuVariable variable;
  variable.name = attribute(&element, "name");
  variable.reference = static_cast<unsigned int>(
      std::strtoul(attribute(&element, "valueReference").c_str(), nullptr, 10));
  variable.causality = attribute(&element, "causality");
  if (variable.causality.empty()) variable.causality = "local";
  variable.unit = attribute(&numbers, "unit");
  const auto declared = units.find(attribute(&numbers, "declaredType"));
  if (variable.unit.empty() && declared != units.end()) variable.unit = declared->second;
  variable.start = numbers.DoubleAttribute("start", std::numeric_limits<double>::quiet_NaN());
  return variable;
}

std::vector<FmuVariable> variablesOf(const XMLElement* root) {
  const std::map<std::string, std::string> units = typeUnits(root);
  std::vector<FmuVariable> variables;
  forEachChild(child(root, "ModelVariables"), [&](const XMLElement& element) {
    const bool is_float = std::string(element.Name()) == "Float64";
    const XMLElement* numbers = is_float ? &element : child(&element, "Real");
    const bool is_array = child(&element, "Dimension") != nullptr;
    if (numbers && !is_array) variables.push_back(variableOf(element, *numbers, units));
  });
  return variables;
}

}  // namespace

ModelDescription parseModelDescription(const std::string& xml) {
  tinyxml2::XMLDocument document;
  if (document.Parse(xml.c_str(), xml.size()) != tinyxml2::XML_SUCCESS)
    throw ConfigurationError(std::string("modelDescription.xml is no XML: ") + document.ErrorStr());
  const XMLElement* root = document.FirstChildElement("fmiModelDescription");
  const std::string version = attribute(root, "fmiVersion");
  const XMLElement* co_simulation = child(root, "CoSimulation");
  const XMLElement* model_exchange = child(root, "ModelExchange");
  const bool is_third = version.rfind("3.", 0) == 0;
  if (version.rfind("2.", 0) != 0 && !is_third)
    throw ConfigurationError("the FMU is of FMI version '" + version +
                             "'; allowed: 2.0 (co-simulation, model exchange) and 3.0 "
                             "(co-simulation)");
  if (!co_simulation && (is_third || !model_exchange))
    throw ConfigurationError("the FMU offers no co-simulation" +
                             std::string(is_third ? "" : " and no model exchange") +
                             "; export it again for co-simulation");
  ModelDescription description;
  description.kind = is_third        ? FmuKind::co_simulation_3
                     : co_simulation ? FmuKind::co_simulation_2
                                     : FmuKind::model_exchange_2;
  description.identifier =
      attribute(co_simulation ? co_simulation : model_exchange, "modelIdentifier");
  if (description.identifier.empty() || description.identifier.find('/') != std::string::npos)
    throw ConfigurationError("modelDescription.xml: modelIdentifier is '" + description.identifier +
                             "'; it must be the name of the FMU's library");
  description.token = attribute(root, is_third ? "instantiationToken" : "guid");
  description.variables = variablesOf(root);
  forEachChild(child(child(root, "ModelStructure"), "Derivatives"),
               [&](const XMLElement& /*unknown*/) { ++description.states; });
  description.event_indicators = root->IntAttribute("numberOfEventIndicators", 0);
  return description;
}

}  // namespace uncertainty_identification
