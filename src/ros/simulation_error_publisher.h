#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <ros/node_handle.h>

#include <memory>
#include <optional>
#include <string>

#include "ros/messages.h"
#include "session/simulation_monitor.h"
#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

messages::SimulationError toMessage(const SimulationState& state, const ros::Time& stamp);

/// Diagnostics of the simulation. OK: it is as far from the machine as at first, or no experiment
/// has been compared yet (nothing). WARN: it has drifted away from the machine, or the newest
/// experiment lacks it.
void diagnoseSimulation(const std::optional<SimulationState>& state,
                        diagnostic_updater::DiagnosticStatusWrapper& status);

/// Publishes the errors of the user's simulation on the latched topic ~simulation_error after each
/// experiment that has one. All functions may be called from any thread, and do nothing where the
/// configuration has no simulation.
class SimulationErrorPublisher {
 public:
  SimulationErrorPublisher(ros::NodeHandle private_node, const Configuration& configuration);

  /// Asks for the errors in a finished experiment, and returns at once.
  void add(const std::shared_ptr<const Experiment>& experiment);

  /// Forgets all experiments.
  void reset();

  /// Whether the configuration has a simulation.
  bool active() const { return monitor_ != nullptr; }

  std::optional<SimulationState> last() const;

 private:
  ros::Publisher publisher_;
  std::unique_ptr<SimulationMonitor> monitor_;  // null without a simulation; uses the publisher
};

}  // namespace uncertainty_identification
