#include "own_simulation/own_structure.h"

#include <iterator>

#include "curves/explain_simulation.h"
#include "own_simulation/linear_surrogate.h"

namespace uncertainty_identification {
namespace {

/// The experiments with the answer of the changed simulation in place of the measurement.
std::vector<Experiment> answersOf(const ChangedSimulation& simulation, const Changes& changes,
                                  const std::vector<Experiment>& experiments) {
  std::vector<Experiment> answers = experiments;
  const ComparedData data = comparedData(experiments, 0, 1);
  for (std::size_t k = 0; k < answers.size(); ++k) {
    answers[k].y = simulation.output(data.runs[k], changes);
    answers[k].valid.clear();
  }
  return answers;
}

/// A logged simulation is a signal of the experiments, but nothing that acts on the machine.
void dropSignal(const Eigen::VectorXd& signal, Experiment* experiment) {
  for (auto each = experiment->signals.begin(); each != experiment->signals.end();)
    each = each->second == signal ? experiment->signals.erase(each) : std::next(each);
}

/// The measurement without what the simulation does beyond the linear model of it.
std::vector<Experiment> linearPart(const std::vector<Experiment>& measured,
                                   const std::vector<Experiment>& answers, Simulation& linear) {
  std::vector<Experiment> rest = measured;
  for (std::size_t k = 0; k < rest.size(); ++k) {
    rest[k].y += linear.run(inputOf(rest[k]), ownValuesOf(linear)) - answers[k].y;
    dropSignal(answers[k].y, &rest[k]);
  }
  return rest;
}

}  // namespace

OwnStructure searchStructure(const ChangedSimulation& simulation, const Changes& changes,
                             const std::vector<Experiment>& fitted,
                             const std::vector<Experiment>& held, int max_causes,
                             const std::function<bool(const std::string& doing)>& progress) {
  const std::vector<Experiment> answers = answersOf(simulation, changes, fitted);
  const LinearFit linear = fitLinear(answers, "");
  if (!linear.simulation || linear.fit < kLeastSurrogateFit) return {{}, linear.fit};
  SimulationSearchOptions options;
  options.max_causes = max_causes;
  options.progress = progress;
  WorkerPool pool(1);
  return {
      explainSimulation(linearPart(fitted, answers, *linear.simulation),
                        linearPart(held, answersOf(simulation, changes, held), *linear.simulation),
                        options, &pool),
      linear.fit};
}

}  // namespace uncertainty_identification
