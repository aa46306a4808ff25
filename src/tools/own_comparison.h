#pragma once

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "io/open_simulation.h"
#include "own_simulation/logged_simulation.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// What the user's simulation gets wrong, if there is one, and the data without it.
struct OwnComparison {
  std::optional<OwnSimulationFindings> findings;
  std::vector<Experiment> data, validation;
  std::vector<Experiment> compared;  ///< those that the fits were measured on, with all signals
};

/// The experiments that were held out, or all where parts of each were.
inline std::vector<Experiment> comparedExperiments(const OwnSimulationFindings& findings,
                                                   const std::vector<Experiment>& data,
                                                   const std::vector<Experiment>& validation) {
  if (!validation.empty()) return validation;
  if (findings.held_out.empty()) return data;
  std::vector<Experiment> held;
  for (const std::string& id : findings.held_out)
    std::copy_if(data.begin(), data.end(), std::back_inserter(held),
                 [&id](const Experiment& each) { return each.id == id; });
  return held;
}

/// Runs the simulation that the configuration gives, if it gives one.
inline OwnComparison compareOwn(const Configuration& configuration,
                                const std::vector<Experiment>& data,
                                const std::vector<Experiment>& validation,
                                const ProgressCallback& progress) {
  OwnComparison own{std::nullopt, data, validation, {}};
  if (!configuration.simulation || data.empty()) return own;
  const OwnSimulationOptions& options = *configuration.simulation;
  const auto simulation = openSimulation(options, data.front().sample_time);
  own.findings = compareSimulation(configuration, *simulation, data, validation, progress);
  own.compared = comparedExperiments(*own.findings, data, validation);
  if (!options.isLogged()) return own;
  own.data = withoutSignal(data, loggedName(options));
  own.validation = withoutSignal(validation, loggedName(options));
  return own;
}

}  // namespace uncertainty_identification
