#include "io/fmu_program.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "fmu/unpacked_fmu.h"
#include "io/program_simulation.h"

namespace uncertainty_identification {
namespace {

namespace fs = std::filesystem;

/// What stands in the folder of the running program, or is searched for as a shell does.
std::string programBeside(const std::string& name) {
  std::error_code error;
  const fs::path beside = fs::read_symlink("/proc/self/exe", error).parent_path() / name;
  return !error && fs::exists(beside, error) ? beside.string() : name;
}

std::string exactText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::vector<SimulationParameter> parametersOf(const OwnSimulationOptions& options,
                                              const ModelDescription& description) {
  std::vector<SimulationParameter> parameters;
  for (const auto& [name, given] : options.parameters) {
    const FmuVariable& known = description.variable("simulation.parameters", name, "parameter");
    parameters.push_back({name, std::isfinite(given.value) ? given.value : known.start,
                          given.unit.empty() ? known.unit : given.unit});
  }
  return parameters;
}

/// The program, with the files that it reads, which end with it.
class FmuProgramSimulation : public Simulation {
 public:
  explicit FmuProgramSimulation(const OwnSimulationOptions& options) : unpacked_(options.fmu) {
    const ModelDescription& known = unpacked_.description();
    known.variable("simulation.input", options.input, "input");
    known.variable("simulation.output", options.output, "output");
    const std::vector<SimulationParameter> parameters = parametersOf(options, known);
    program_ = startProgramSimulation({fmuCommand(options, unpacked_.folder(), parameters),
                                       "the FMU " + options.fmu, parameters, options.time_limit,
                                       options.memory_limit});
  }

  std::string description() const override { return program_->description(); }
  std::vector<SimulationParameter> parameters() const override { return program_->parameters(); }
  bool canRerun() const override { return true; }
  Eigen::VectorXd run(const SimulationInput& input, const Eigen::VectorXd& values) override {
    return program_->run(input, values);
  }

 private:
  const UnpackedFmu unpacked_;
  std::unique_ptr<Simulation> program_;
};

}  // namespace

std::vector<std::string> fmuCommand(const OwnSimulationOptions& options, const std::string& path,
                                    const std::vector<SimulationParameter>& parameters) {
  std::vector<std::string> command{programBeside("simulate_fmu"),
                                   "--fmu",
                                   fs::absolute(path).string(),
                                   "--input",
                                   options.input,
                                   "--output",
                                   options.output,
                                   "--steps",
                                   std::to_string(options.steps_per_sample)};
  for (const SimulationParameter& each : parameters) {
    command.push_back("--parameter");
    command.push_back(each.name + "=" + exactText(each.value));
  }
  return command;
}

std::unique_ptr<Simulation> startFmuSimulation(const OwnSimulationOptions& options) {
  return std::make_unique<FmuProgramSimulation>(options);
}

}  // namespace uncertainty_identification
