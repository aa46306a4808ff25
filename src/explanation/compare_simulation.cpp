#include "explanation/split.h"
#include "own_simulation/examine.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

OwnSimulationFindings compareSimulation(const Configuration& configuration, Simulation& simulation,
                                        const std::vector<Experiment>& experiments,
                                        const std::vector<Experiment>& validation,
                                        const ProgressCallback& progress) {
  const Split data = split(configuration, experiments, validation);
  ExamineOptions options;
  options.max_causes = configuration.explanation.max_causes;
  constexpr int kUnlimited = 1000000;  // runs of a transfer function cost nothing
  const auto& own = configuration.simulation;
  options.max_simulations = own && own->isProgram() ? own->max_simulations : kUnlimited;
  options.progress = [&](const std::string& doing) {
    return !progress || progress({doing, 0, std::nullopt});
  };
  return examine(simulation, data.train, data.fitted_to ? std::vector<Experiment>() : data.held,
                 options);
}

}  // namespace uncertainty_identification
