#pragma once

#include <functional>
#include <string>
#include <vector>

#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/own_simulation/findings.h"
#include "uncertainty_identification/own_simulation/simulation.h"

namespace uncertainty_identification {

/// Share of each experiment that is fitted to where no experiment is held out; the rest is.
constexpr double kFittedShare = 2.0 / 3;

struct ExamineOptions {
  int max_causes = 4;
  int max_simulations = 2000;
  bool structure = true;  ///< look for curves, too
  /// Called before each run with what is being done; false cancels. May be empty.
  std::function<bool(const std::string& doing)> progress;
};

/// Compares a simulation with `fitted`, names what is wrong with it and measures on `held` what
/// naming it gains. Where `held` is empty, the last third of each experiment is held out. Throws
/// DataError where the simulation fails or nothing can be compared, ConfigurationError where
/// max_simulations is less than one run over each experiment.
OwnSimulationFindings examine(Simulation& simulation, const std::vector<Experiment>& fitted,
                              const std::vector<Experiment>& held, const ExamineOptions& options);

}  // namespace uncertainty_identification
