#include "own_simulation/extension.h"

#include <cmath>

#include "own_simulation/linear_surrogate.h"

namespace uncertainty_identification {
namespace {

/// What a change does to the output, in seconds and units of the data.
void addChange(const Change& change, double sample_time, OwnExtension* extension) {
  switch (change.kind) {
    case ChangeKind::parameter:
      break;
    case ChangeKind::gain:
      extension->gain = 1 + change.at[0];
      break;
    case ChangeKind::offset:
      extension->offset = change.at[0];
      break;
    case ChangeKind::delay:
      extension->delay = change.at[0] * sample_time;
      break;
    case ChangeKind::lag:
      extension->lag = change.at[0] * sample_time;
      break;
    case ChangeKind::time_constant:
      extension->lead = std::exp(change.at[0]) * sample_time;
      extension->lag = std::exp(change.at[1]) * sample_time;
      break;
    case ChangeKind::initial_state:
      extension->transient = change.at[0] * sample_time;
      break;
  }
}

}  // namespace

OwnExtension extensionOf(const ChangedSimulation& simulation, const Changes& changes,
                         double sample_time, const Simulation& plant, bool is_surrogate) {
  OwnExtension extension;
  extension.sample_time = sample_time;
  const Eigen::VectorXd values = simulation.values(changes);
  if (!is_surrogate) extension.parameters = simulation.runs().parameters();
  for (std::size_t k = 0; k < extension.parameters.size(); ++k)
    extension.parameters[k].value = values[static_cast<Eigen::Index>(k)];
  extension.yours = plant.filterAt(ownValuesOf(plant), sample_time);
  if (extension.yours) extension.measured = plant.filterAt(values, sample_time);
  for (const Change& change : changes) addChange(change, sample_time, &extension);
  return extension;
}

}  // namespace uncertainty_identification
