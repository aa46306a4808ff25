// Runs a functional mock-up unit for each line that it reads; --help says how. In a process of its
// own, so that an FMU that crashes or hangs takes nobody along.

#include <unistd.h>

#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "fmu/fmu_simulation.h"
#include "io/command_line.h"
#include "io/simulation_protocol.h"
#include "uncertainty_identification/errors.h"

namespace {

namespace ui = uncertainty_identification;
namespace po = boost::program_options;

/// "mass=1.2"
void addParameter(const std::string& text, ui::FmuSignals* signals) {
  const std::size_t sign = text.rfind('=');
  std::size_t used = 0;
  try {
    if (sign == std::string::npos || sign == 0) throw std::invalid_argument("no sign");
    const double value = std::stod(text.substr(sign + 1), &used);
    if (sign + 1 + used != text.size()) throw std::invalid_argument("more than a number");
    signals->parameters[text.substr(0, sign)] = value;
  } catch (const std::logic_error&) {
    throw ui::ConfigurationError("--parameter: found '" + text + "'; allowed: NAME=NUMBER");
  }
}

/// The standard output for answers; what the FMU prints goes to the standard error.
std::FILE* answersAlone() {
  std::FILE* answers = fdopen(dup(STDOUT_FILENO), "w");
  dup2(STDERR_FILENO, STDOUT_FILENO);
  return answers;
}

int run(const po::variables_map& arguments) {
  ui::FmuSignals signals;
  signals.input = arguments["input"].as<std::string>();
  signals.output = arguments["output"].as<std::string>();
  signals.steps_per_sample = arguments["steps"].as<int>();
  if (arguments.count("parameter") > 0)
    for (const auto& each : arguments["parameter"].as<std::vector<std::string>>())
      addParameter(each, &signals);
  std::FILE* answers = answersAlone();
  const auto fmu = ui::loadFmu(arguments["fmu"].as<std::string>(), signals);
  for (std::string line; std::getline(std::cin, line);) {
    const ui::SimulationRequest request = ui::requestFrom(line, fmu->parameters());
    std::fputs(ui::answerText(fmu->run(request.input, request.values)).c_str(), answers);
    std::fflush(answers);
  }
  return ui::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  ui::Program program;
  program.name = "simulate_fmu";
  program.usage = "--fmu MODEL.fmu --input NAME --output NAME [--parameter NAME=VALUE]...";
  program.purpose =
      R"(Runs a functional mock-up unit (FMI 2.0 co-simulation or model exchange, FMI 3.0 co-simulation) for
each line of JSON on its standard input, and answers with a line (docs/own_simulation.md). explain
starts it where a configuration gives simulation: {fmu: ...}.
Exit status: 0 done; 1 the FMU failed, or an internal error; 2 wrong usage, or a file that cannot be
read.)";
  program.options.add_options()  //
      ("fmu", po::value<std::string>()->required()->value_name("FILE"),
       "the FMU, or the folder that it was unpacked into")                                        //
      ("input", po::value<std::string>()->required()->value_name("NAME"), "variable that u is")   //
      ("output", po::value<std::string>()->required()->value_name("NAME"), "variable that y is")  //
      ("parameter", po::value<std::vector<std::string>>()->composing()->value_name("NAME=VALUE"),
       "a parameter that requests may change, with its value otherwise; may be repeated")  //
      ("steps", po::value<int>()->default_value(10)->value_name("N"),
       "steps of the integration from sample to sample, of model exchange");
  program.run = run;
  return ui::runProgram(program, argc, argv);
}
