#include "explanation/search_simulation.h"

#include "explanation/doubtful_curves.h"

namespace uncertainty_identification {

SimulationCauses searchSimulation(const Configuration& configuration, const Split& data,
                                  SearchProgress* progress, WorkerPool* pool) {
  const ExplanationOptions& asked = configuration.explanation;
  const Offsets offsets = configuration.estimation.offsets;
  const bool own_levels = offsets == Offsets::automatic || offsets == Offsets::per_experiment;
  const SimulationSearchOptions options{
      asked.max_causes, own_levels, asked.time_limit / 3, asked.exclude,
      [progress](const std::string& doing) { return progress->report(doing, 0, std::nullopt); }};
  const std::vector<Experiment> held = data.fitted_to ? std::vector<Experiment>() : data.held;
  SimulationCauses found = explainSimulation(data.train, held, options, pool);
  dropDoubtfulCurves(data.train, &found);
  if (found.ended_early && !progress->cancelled()) progress->endSearch();
  return found;
}

}  // namespace uncertainty_identification
