#include "io/open_simulation.h"

#include <algorithm>
#include <utility>

#include "io/fmu_program.h"
#include "io/program_simulation.h"
#include "math/polynomial.h"
#include "own_simulation/linear_simulation.h"
#include "own_simulation/logged_simulation.h"
#include "uncertainty_identification/errors.h"
#include "uncertainty_identification/io/result_json.h"

namespace uncertainty_identification {
namespace {

/// The nominal model of a result as a transfer function in z.
OwnModelOptions modelOf(const NominalModelEstimate& nominal) {
  OwnModelOptions model;
  model.domain = TransferDomain::z;
  model.sample_time = nominal.sample_time;
  const Eigen::VectorXd denominator = withLeadingOne(nominal.a);
  // q^-delay (b1 + b2 q^-1 + ..) / (1 + a1 q^-1 + ..), by a power of z that makes both polynomials.
  const Eigen::Index length = std::max(nominal.delay + nominal.b.size(), denominator.size());
  model.num = Eigen::VectorXd::Zero(length);
  model.num.segment(nominal.delay, nominal.b.size()) = nominal.b;
  model.den = Eigen::VectorXd::Zero(length);
  model.den.head(denominator.size()) = denominator;
  return model;
}

std::unique_ptr<Simulation> fromResult(const std::string& path, double sample_time) {
  const Result result = loadResult(path);
  const NominalModelEstimate& nominal = result.estimate.nominal_model;
  if (nominal.b.size() == 0)
    throw ConfigurationError("simulation.result: " + path + " holds no nominal model");
  try {
    return makeLinearSimulation(factorsOf(modelOf(nominal), sample_time),
                                "the nominal model of " + path);
  } catch (const ConfigurationError& error) {
    throw ConfigurationError("simulation.result: " + path + ": " + error.what());
  }
}

ProgramToRun programOf(const OwnSimulationOptions& options) {
  ProgramToRun program{options.command,
                       "the program " + options.command.front(),
                       {},
                       options.time_limit,
                       options.memory_limit};
  for (const auto& [name, parameter] : options.parameters)
    program.parameters.push_back({name, parameter.value, parameter.unit});
  return program;
}

}  // namespace

std::string loggedName(const OwnSimulationOptions& options) {
  return options.column.empty() ? "simulation of the user" : options.column;
}

Configuration withLoggedSimulation(Configuration configuration) {
  if (!configuration.simulation || !configuration.simulation->isLogged()) return configuration;
  const OwnSimulationOptions& simulation = *configuration.simulation;
  SignalOptions signal;
  signal.name = loggedName(simulation);  // no column of its own: other columns stay covariates
  signal.topic = simulation.topic.empty() ? simulation.column : simulation.topic;
  signal.field = simulation.field;
  signal.scale = configuration.output.scale;
  signal.offset = configuration.output.offset;
  const auto same = [&](const SignalOptions& each) { return each.name == signal.name; };
  auto& listed = configuration.covariates;
  if (std::none_of(listed.begin(), listed.end(), same)) listed.push_back(std::move(signal));
  return configuration;
}

std::unique_ptr<Simulation> openSimulation(const OwnSimulationOptions& options,
                                           double sample_time) {
  if (options.isLogged())
    return makeLoggedSimulation(loggedName(options), options.column.empty()
                                                         ? "the topic " + options.topic
                                                         : "the column " + options.column);
  if (!options.command.empty()) return startProgramSimulation(programOf(options));
  if (!options.fmu.empty()) return startFmuSimulation(options);
  if (!options.result.empty()) return fromResult(options.result, sample_time);
  return makeLinearSimulation(factorsOf(options.model, sample_time),
                              "the transfer function of simulation.model");
}

void requirePublishedSimulation(const Configuration& configuration) {
  if (!configuration.simulation) return;
  const bool whole = configuration.experiment.mode == ExperimentMode::message;
  if (whole && !configuration.simulation->column.empty()) return;
  if (!whole && !configuration.simulation->topic.empty()) return;
  throw ConfigurationError(
      std::string("simulation: a node starts no program of the user, but compares what one "
                  "publishes; give ") +
      (whole ? "column: the name of a covariate in the messages (experiment.mode is message)"
             : "topic, and field where its messages have several") +
      ", or leave it out, and run the program explain with it");
}

void refuseSimulation(const Configuration& configuration, const std::string& who) {
  if (configuration.simulation)
    throw ConfigurationError("simulation: " + who +
                             "; leave it out, and run the program explain with it");
}

}  // namespace uncertainty_identification
