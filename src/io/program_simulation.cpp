#include "io/program_simulation.h"

#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "io/child_process.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using nlohmann::json;

constexpr std::size_t kBytesPerSample = 64, kShortestLimit = 1 << 16;  // of an answer

json listOf(const Eigen::VectorXd& values) {
  return std::vector<double>(values.data(), values.data() + values.size());
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

class ProgramSimulation : public Simulation {
 public:
  explicit ProgramSimulation(const OwnSimulationOptions& options)
      : program_(options.command.front()),
        time_limit_(options.time_limit),
        process_(options.command) {
    for (const auto& [name, parameter] : options.parameters)
      parameters_.push_back({name, parameter.value, parameter.unit});
  }

  std::string description() const override { return "the program " + program_; }
  std::vector<SimulationParameter> parameters() const override { return parameters_; }
  bool canRerun() const override { return true; }

  Eigen::VectorXd run(const SimulationInput& input, const Eigen::VectorXd& values) override {
    json request{{"sample_time", input.sample_time},
                 {"u", listOf(input.u)},
                 {"covariates", json::object()},
                 {"parameters", json::object()}};
    for (const auto& [name, value] : input.scalars) request["covariates"][name] = value;
    for (const auto& [name, signal] : input.signals) request["covariates"][name] = listOf(signal);
    for (std::size_t k = 0; k < parameters_.size(); ++k)
      request["parameters"][parameters_[k].name] = values[static_cast<Eigen::Index>(k)];
    const std::size_t most =
        kShortestLimit + kBytesPerSample * static_cast<std::size_t>(input.u.size());
    try {
      return outputFrom(process_.ask(request.dump() + "\n", time_limit_, most));
    } catch (const DataError& error) {
      throw DataError(description() + ": " + error.what());
    }
  }

 private:
  static Eigen::VectorXd outputFrom(const std::string& line) {
    const json answer = parsed(line);
    if (!answer.is_object() || !answer.contains("y") || !answer["y"].is_array())
      throw DataError("it wrote " + excerptOf(line) +
                      R"(; expected one line {"y": [...]} for each line of input, and nothing else)"
                      " (messages belong to the standard error)");
    const json& list = answer["y"];
    Eigen::VectorXd y(static_cast<Eigen::Index>(list.size()));
    for (std::size_t k = 0; k < list.size(); ++k) {
      if (!list[k].is_number() && !list[k].is_null())
        throw DataError("sample " + std::to_string(k) + " of its answer is " +
                        excerptOf(list[k].dump()) + "; expected a number");
      y[static_cast<Eigen::Index>(k)] =
          list[k].is_null() ? std::numeric_limits<double>::quiet_NaN() : list[k].get<double>();
    }
    return y;
  }

  std::string program_;
  double time_limit_;
  std::vector<SimulationParameter> parameters_;
  ChildProcess process_;
};

}  // namespace

std::unique_ptr<Simulation> startProgramSimulation(const OwnSimulationOptions& options) {
  return std::make_unique<ProgramSimulation>(options);
}

}  // namespace uncertainty_identification
