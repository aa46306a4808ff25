#pragma once

#include <functional>
#include <string>
#include <vector>

#include "math/worker_pool.h"
#include "uncertainty_identification/curves/simulation_causes.h"
#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

struct SimulationSearchOptions {
  int max_causes = 3;
  bool own_levels = false;            ///< also counts outputs from a level of each experiment
  double time_limit = 0;              ///< [s]; 0: none
  std::vector<std::string> excluded;  ///< names of causes that are not considered
  std::function<bool(const std::string& doing)>
      progress;  ///< returns false to cancel; may be empty
};

/// Whether the inputs of all records together make few steps. Steps of a few sizes show that the
/// answers differ, but many curves follow so few answers, and so do gains that differ by chance.
bool areFewSteps(const std::vector<Experiment>& fitted, const std::vector<Experiment>& held);

/// Looks for what the free simulation of a small linear plant gets wrong: curves at places of the
/// simulation, fitted to windows of `fitted`, accepted and measured on windows of `held`. Where
/// `held` is empty, every third window is held out. Throws nothing: data that are too few give a
/// result with the reason in `skipped`.
SimulationCauses explainSimulation(const std::vector<Experiment>& fitted,
                                   const std::vector<Experiment>& held,
                                   const SimulationSearchOptions& options, WorkerPool* pool);

}  // namespace uncertainty_identification
