#include "uncertainty_identification/own_simulation_options.h"

#include <algorithm>
#include <cmath>

#include "configuration/require.h"

namespace uncertainty_identification {
namespace {

void requireOneForm(const OwnModelOptions& model) {
  const bool coefficients = model.num.size() + model.den.size() > 0;
  const bool factors = !model.zeros.empty() || !model.poles.empty();
  const bool physical = std::any_of(
      model.physical.begin(), model.physical.end(),
      [](const auto& each) { return each.first != "gain" && each.first != "dead_time"; });
  require(coefficients + factors + physical == 1, "simulation.model",
          coefficients + factors + physical == 0 ? "no form" : "several forms",
          "one form: num and den, or poles (with zeros and gain), or physical parameters (gain, "
          "tau1, omega1, zeta1, zero1, dead_time)");
  require(!physical || model.domain == TransferDomain::s, "simulation.model.domain", "z",
          "s, as long as physical parameters are given");
  require(!coefficients || (model.num.size() > 0 && model.den.size() > 0), "simulation.model",
          model.num.size() > 0 ? "num without den" : "den without num", "both num and den");
  require(!coefficients || model.physical.count("gain") == 0, "simulation.model.gain",
          "a gain beside num and den", "no gain: multiply num by it");
  require(!factors || !model.poles.empty(), "simulation.model.poles", "none", "at least one pole");
}

void validateModel(const OwnModelOptions& model) {
  requireOneForm(model);
  require(model.num.allFinite() && model.den.allFinite(), "simulation.model.num, den",
          "an entry that is not finite", "finite numbers");
  require(model.sample_time >= 0 && std::isfinite(model.sample_time),
          "simulation.model.sample_time", model.sample_time, "a finite number, 0 or above");
  for (const auto& [name, value] : model.physical) {
    const bool may_be_negative = name == "gain" || name.rfind("zero", 0) == 0;
    const bool may_be_zero = may_be_negative || name == "dead_time";
    const bool ok =
        std::isfinite(value) && (may_be_negative || value > 0 || (may_be_zero && value == 0));
    require(ok, "simulation.model." + name, value,
            may_be_negative ? "a finite number"
            : may_be_zero   ? "0 or above"
                            : "above 0");
  }
}

}  // namespace

const std::vector<std::string>& physicalNames() {
  static const std::vector<std::string> kNames{"gain",   "tau1",  "tau2",   "tau3",     "tau4",
                                               "omega1", "zeta1", "omega2", "zeta2",    "omega3",
                                               "zeta3",  "zero1", "zero2",  "dead_time"};
  return kNames;
}

namespace {

void validateFmu(const OwnSimulationOptions& options) {
  const bool is_fmu = !options.fmu.empty();
  require(is_fmu == !options.input.empty(), "simulation.input", "'" + options.input + "'",
          is_fmu ? "the variable of the FMU that u is" : "none without fmu");
  require(is_fmu == !options.output.empty(), "simulation.output", "'" + options.output + "'",
          is_fmu ? "the variable of the FMU that y is" : "none without fmu");
  requireRange("simulation.steps_per_sample", options.steps_per_sample, 1, 100000);
}

}  // namespace

void OwnSimulationOptions::validate() const {
  const int given = has_model + !result.empty() + !command.empty() + !fmu.empty() +
                    !column.empty() + (!topic.empty() && column.empty());
  require(given == 1, "simulation", given == 0 ? "none of them" : "several of them",
          "exactly one of model, result, command, fmu and column (or topic)");
  if (has_model) validateModel(model);
  require(command.empty() || !command.front().empty(), "simulation.command", "an empty text",
          "the program and its arguments, such as [./my_sim, --fast]");
  validateFmu(*this);
  require(parameters.empty() || isProgram(), "simulation.parameters", "parameters",
          "none without command or fmu: the other ways have parameters of their own");
  for (const auto& [name, parameter] : parameters)
    require(std::isfinite(parameter.value) || (!fmu.empty() && std::isnan(parameter.value)),
            "simulation.parameters." + name + ".value", parameter.value,
            "the value that your simulation has now, a finite number");
  require(time_limit > 0 && std::isfinite(time_limit), "simulation.time_limit", time_limit,
          "a finite number above 0");
  require(memory_limit >= 10 && std::isfinite(memory_limit), "simulation.memory_limit",
          memory_limit, "10 or above, in MB");
  requireRange("simulation.max_simulations", max_simulations, 10, 100000000);
}

}  // namespace uncertainty_identification
