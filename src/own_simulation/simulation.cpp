#include "uncertainty_identification/own_simulation/simulation.h"

namespace uncertainty_identification {

SimulationInput inputOf(const Experiment& experiment) {
  return {experiment.sample_time, experiment.u, experiment.signals, experiment.scalars, {}};
}

}  // namespace uncertainty_identification
