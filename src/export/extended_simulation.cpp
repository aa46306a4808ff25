#include "export/extended_simulation.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "export/extended_templates.h"
#include "io/atomic_file.h"
#include "io/fmu_program.h"
#include "io/json_file.h"
#include "io/open_simulation.h"
#include "io/output_file.h"
#include "io/own_simulation_binding.h"
#include "io/tree_writer.h"
#include "own_simulation/examine.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/csv.h"

namespace uncertainty_identification {
namespace {

using nlohmann::json;

namespace fs = std::filesystem;

/// In the templates, in place of what was found.
const std::string kMark = "@FOUND@", kCppMark = "// " + kMark;
constexpr std::array<const char*, 4> kFiles{"extended_simulation.json", "extended_simulation.py",
                                            "extended_simulation.cpp", "held_out.csv"};

/// Constants of the C++ file, and their keys in the JSON file.
constexpr std::array<std::pair<const char*, const char*>, 10> kNumbers{
    {{"kSampleTime", "sample_time"},
     {"kDelay", "delay"},
     {"kLead", "lead"},
     {"kLag", "lag"},
     {"kGain", "gain"},
     {"kOffset", "offset"},
     {"kTransient", "transient"},
     {"kComparedFrom", "compared_from"},
     {"kFitBefore", "fit_before"},
     {"kFitAfter", "fit_after"}}};

std::string filled(std::string text, const std::string& mark, const std::string& found) {
  return text.replace(text.find(mark), mark.size(), found);
}

/// The parameters with the user's values, the measured ones, and the intervals of those that were
/// found to be wrong.
json parametersOf(const OwnSimulationFindings& findings) {
  json list = json::array();
  for (const SimulationParameter& parameter : findings.extension.parameters) {
    json entry{{"name", parameter.name},
               {"unit", parameter.unit},
               {"yours", parameter.value},
               {"measured", parameter.value}};
    for (const OwnCause& cause : findings.causes)
      if (cause.parameter == parameter.name)
        for (const OwnValue& value : cause.values) entry.update(writtenTree(value));
    list.push_back(entry);
  }
  return list;
}

/// The parameters with the user's values.
std::vector<SimulationParameter> ownParameters(const OwnSimulationFindings& findings) {
  std::vector<SimulationParameter> parameters = findings.extension.parameters;
  for (SimulationParameter& parameter : parameters)
    for (const OwnCause& cause : findings.causes)
      if (cause.parameter == parameter.name) parameter.value = cause.values.front().yours;
  return parameters;
}

/// 17 significant digits, so that no number changes.
std::string numberText(const json& value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value.get<double>());
  return text;
}

std::string jsonListText(const json& values) {
  std::string text;
  for (const json& value : values)
    text += (text.empty() ? "" : ", ") + (value.is_string() ? value.dump() : numberText(value));
  return "{" + text + "}";
}

std::string mapText(const json& parameters, const char* key) {
  std::string text;
  for (const json& each : parameters)
    text += (text.empty() ? "{" : ", {") + each["name"].dump() + ", " + numberText(each[key]) + "}";
  return "{" + text + "}";
}

std::string filterText(const json& filter) {
  if (filter.is_null()) return "{}";
  return "{" + jsonListText(filter["num"]) + ", " + jsonListText(filter["den"]) + "}";
}

std::string curveText(const json& curve) {
  if (curve.is_null()) return "{}";
  return "{" + curve["of"].dump() + ", " + jsonListText(curve["signal"]) + ", " +
         jsonListText(curve["value"]) + "}";
}

}  // namespace

void requireExtendedWritable(const std::string& folder, const Configuration& configuration,
                             std::vector<std::string> inputs, const std::string& output) {
  if (!configuration.simulation)
    throw ConfigurationError(
        "--write-extended: the configuration gives no simulation to extend; add simulation "
        "(docs/own_simulation.md)");
  const OwnSimulationOptions& own = *configuration.simulation;
  inputs.insert(inputs.end(), own.command.begin(), own.command.end());
  for (const std::string& file : {own.fmu, own.result})
    if (!file.empty()) inputs.push_back(file);
  if (!fs::is_directory(folder)) return requireWritable(folder, inputs);
  std::vector<std::string> outputs{output};
  for (const char* name : kFiles) {
    outputs.push_back((fs::path(folder) / name).string());
    requireWritable(outputs.back(), inputs);
  }
  requireDistinct(outputs);
}

json extendedSimulationJson(const OwnSimulationOptions& options,
                            const OwnSimulationFindings& findings, const std::string& folder) {
  json extended = writtenTree(findings.extension);
  std::vector<std::string> command = options.command;
  if (!options.fmu.empty()) command = fmuCommand(options, options.fmu, ownParameters(findings));
  extended["kind"] = options.isLogged() ? "logged" : command.empty() ? "linear" : "program";
  extended["simulation"] = findings.simulation;
  extended["command"] = command;
  extended["folder"] = command.empty() ? "" : folder;
  extended["column"] = options.isLogged() ? loggedName(options) : "";
  extended["parameters"] = parametersOf(findings);
  extended["sentence"] = findings.sentence;
  extended["fit_before"] = findings.fit_before;
  extended["fit_after"] = findings.fit_after;
  extended["held_out"] = findings.held_out;
  extended["compared_from"] = findings.held_out.empty() ? kFittedShare : 0;
  return extended;
}

std::string extendedSimulationPython(const json& extended) {
  return filled(extendedTemplates().python, kMark, extended.dump(1));
}

std::string extendedSimulationCpp(const json& extended) {
  std::string found =
      "const std::string kKind = " + extended["kind"].dump() +
      ", kColumn = " + extended["column"].dump() + ";\n" +
      "const std::vector<std::string> kCommand = " + jsonListText(extended["command"]) +
      ";\nconst char* const kFolder = " + extended["folder"].dump() + ";\n" +
      "const Parameters kYours = " + mapText(extended["parameters"], "yours") +
      ";\nconst Parameters kMeasured = " + mapText(extended["parameters"], "measured") +
      ";\nconst Curve kCurve = " + curveText(extended["curve"]) +
      ";\nconst Filter kFilterYours = " + filterText(extended["yours"]) +
      ";\nconst Filter kFilterMeasured = " + filterText(extended["measured"]) + ";\n";
  for (const auto& [name, key] : kNumbers)
    found += std::string("constexpr double ") + name + " = " + numberText(extended[key]) + ";\n";
  return filled(extendedTemplates().cpp, kCppMark, found);
}

void writeExtendedSimulation(const std::string& folder, const OwnSimulationOptions& options,
                             const OwnSimulationFindings& findings,
                             const std::vector<Experiment>& compared) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw FileError(folder + ": the folder cannot be created: " + error.message());
  const json extended = extendedSimulationJson(options, findings, fs::current_path().string());
  const auto path = [&folder](std::size_t k) { return (fs::path(folder) / kFiles[k]).string(); };
  saveJson(path(0), extended);
  writeFileAtomically(path(1), extendedSimulationPython(extended));
  writeFileAtomically(path(2), extendedSimulationCpp(extended));
  writeCsv(path(3), compared);
}

}  // namespace uncertainty_identification
