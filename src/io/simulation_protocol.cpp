#include "io/simulation_protocol.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using nlohmann::json;

json numbersOf(const Eigen::VectorXd& values) {
  return std::vector<double>(values.data(), values.data() + values.size());
}

Eigen::VectorXd vectorFrom(const json& list) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(list.size()));
  for (std::size_t k = 0; k < list.size(); ++k)
    values[static_cast<Eigen::Index>(k)] =
        list[k].is_null() ? std::numeric_limits<double>::quiet_NaN() : list[k].get<double>();
  return values;
}

/// The beginning of what the program wrote, for a message.
std::string excerptOf(const std::string& line) {
  constexpr std::size_t kShown = 80;
  std::string text = "'" + line.substr(0, kShown) + (line.size() > kShown ? "..." : "") + "'";
  for (char& each : text)
    if (static_cast<unsigned char>(each) < 32 || static_cast<unsigned char>(each) > 126) each = '?';
  return text;
}

/// JSON knows no NaN; Python's and other writers give it all the same.
json parsed(std::string line) {
  for (const char* word : {"-Infinity", "Infinity", "NaN", "-inf", "inf", "nan"}) {
    const std::string searched = word;
    for (std::size_t at = line.find(searched); at != std::string::npos;
         at = line.find(searched, at))
      line.replace(at, searched.size(), "null");
  }
  return json::parse(line, nullptr, false);
}

}  // namespace

std::string requestText(const SimulationInput& input,
                        const std::vector<SimulationParameter>& parameters,
                        const Eigen::VectorXd& values) {
  json request{{"sample_time", input.sample_time},
               {"u", numbersOf(input.u)},
               {"covariates", json::object()},
               {"parameters", json::object()}};
  for (const auto& [name, value] : input.scalars) request["covariates"][name] = value;
  for (const auto& [name, signal] : input.signals) request["covariates"][name] = numbersOf(signal);
  for (std::size_t k = 0; k < parameters.size(); ++k)
    request["parameters"][parameters[k].name] = values[static_cast<Eigen::Index>(k)];
  return request.dump() + "\n";
}

SimulationRequest requestFrom(const std::string& line,
                              const std::vector<SimulationParameter>& parameters) {
  SimulationRequest request;
  try {
    const json tree = json::parse(line);
    request.input.sample_time = tree.at("sample_time").get<double>();
    request.input.u = vectorFrom(tree.at("u"));
    request.values.resize(static_cast<Eigen::Index>(parameters.size()));
    const json given = tree.value("parameters", json::object());
    for (std::size_t k = 0; k < parameters.size(); ++k)
      request.values[static_cast<Eigen::Index>(k)] =
          given.value(parameters[k].name, parameters[k].value);
  } catch (const json::exception& error) {
    throw DataError("found the line " + excerptOf(line) +
                    R"(; expected {"sample_time": .., "u": [..], "parameters": {..}}: )" +
                    error.what());
  }
  return request;
}

std::string answerText(const Eigen::VectorXd& y) { return json{{"y", numbersOf(y)}}.dump() + "\n"; }

Eigen::VectorXd answerFrom(const std::string& line) {
  const json answer = parsed(line);
  if (!answer.is_object() || !answer.contains("y") || !answer["y"].is_array())
    throw DataError("it wrote " + excerptOf(line) +
                    R"(; expected one line {"y": [...]} for each line of input, and nothing else)"
                    " (messages belong to the standard error)");
  const json& list = answer["y"];
  for (std::size_t k = 0; k < list.size(); ++k)
    if (!list[k].is_number() && !list[k].is_null())
      throw DataError("sample " + std::to_string(k) + " of its answer is " +
                      excerptOf(list[k].dump()) + "; expected a number");
  return vectorFrom(list);
}

}  // namespace uncertainty_identification
