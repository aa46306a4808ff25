#include "ros/simulation_error_publisher.h"

#include <ros/console.h>

#include "io/open_simulation.h"
#include "own_simulation/describe_errors.h"

namespace uncertainty_identification {
namespace {

messages::SimulationErrorNumber toMessage(const ErrorNumber& number) {
  messages::SimulationErrorNumber message;
  message.value = number.value;
  message.standard_error = number.standard_error;
  message.lower = number.lower;
  message.upper = number.upper;
  return message;
}

}  // namespace

messages::SimulationError toMessage(const SimulationState& state, const ros::Time& stamp) {
  const SimulationErrors& errors = state.errors;
  messages::SimulationError message;
  message.header.stamp = stamp;
  message.experiment = errors.id;
  message.samples = static_cast<std::uint32_t>(errors.samples);
  message.fit = toMessage(errors.fit);
  message.bias = toMessage(errors.bias);
  message.gain = toMessage(errors.gain);
  message.delay = toMessage(errors.delay);
  message.untold = errors.untold;
  message.drifted = state.drift.drifted;
  message.drift_message = state.drift.message;
  return message;
}

void diagnoseSimulation(const std::optional<SimulationState>& state,
                        diagnostic_updater::DiagnosticStatusWrapper& status) {
  using Level = diagnostic_msgs::DiagnosticStatus;
  if (!state) {
    status.summary(Level::OK, "no experiment has been compared with the simulation yet");
    return;
  }
  status.summary(state->drift.drifted ? Level::WARN : Level::OK, state->drift.message);
  if (!state->missing_in.empty())
    status.mergeSummary(Level::WARN, "experiment '" + state->missing_in +
                                         "' lacks the simulation; check that it publishes while "
                                         "experiments run");
  status.add("experiment", state->errors.id);
  status.addf("fit [%]", "%.4g", state->errors.fit.value);
  status.addf("bias", "%.4g", state->errors.bias.value);
  status.addf("gain", "%.4g", state->errors.gain.value);
  status.addf("delay error [s]", "%.4g", state->errors.delay.value);
}

SimulationErrorPublisher::SimulationErrorPublisher(ros::NodeHandle private_node,
                                                   const Configuration& configuration)
    : publisher_(private_node.advertise<messages::SimulationError>("simulation_error", 1, true)) {
  if (!configuration.simulation) return;
  monitor_ = std::make_unique<SimulationMonitor>(
      loggedName(*configuration.simulation), [this](const SimulationState& state) {
        ROS_INFO_STREAM("experiment '" << state.errors.id << "': " << describe(state.errors));
        publisher_.publish(toMessage(state, ros::Time::now()));
      });
}

void SimulationErrorPublisher::add(const std::shared_ptr<const Experiment>& experiment) {
  if (monitor_) monitor_->add(experiment);
}

void SimulationErrorPublisher::reset() {
  if (monitor_) monitor_->reset();
}

std::optional<SimulationState> SimulationErrorPublisher::last() const {
  return monitor_ ? monitor_->last() : std::nullopt;
}

}  // namespace uncertainty_identification
