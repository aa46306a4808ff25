#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "own_simulation/simulation_drift.h"
#include "own_simulation/simulation_errors.h"
#include "session/work_queue.h"

namespace uncertainty_identification {

/// What is known of the simulation after an experiment.
struct SimulationState {
  SimulationErrors errors;  ///< in the newest experiment that has the simulation
  DriftDecision drift;      ///< over all of them
  std::string missing_in;   ///< id of the newest experiment if it lacks the simulation, else empty
};

/// Follows how far the simulation of a user is from the machine over the experiments of a node, in
/// a thread of its own. All functions may be called from any thread.
class SimulationMonitor {
 public:
  /// `signal`: the covariate of the experiments that the simulation is. `told` is called in the
  /// monitor's thread after each experiment that has it, and must not call the monitor.
  SimulationMonitor(std::string signal, std::function<void(const SimulationState&)> told);

  /// Blocks until the experiment that is being compared is done; others are left.
  ~SimulationMonitor();

  SimulationMonitor(const SimulationMonitor&) = delete;
  SimulationMonitor& operator=(const SimulationMonitor&) = delete;

  /// Asks for the comparison with a finished experiment, and returns at once. Experiments are
  /// compared in order.
  void add(std::shared_ptr<const Experiment> experiment);

  /// Forgets all experiments; of those added before none is told any more.
  void reset();

  /// The state now; nothing before the first experiment was compared.
  std::optional<SimulationState> last() const;

 private:
  struct Item {
    unsigned generation;  // value of generation_ when the experiment was added
    std::shared_ptr<const Experiment> experiment;
  };

  void run();
  void compare(const Item& item);

  const std::string signal_;
  const std::function<void(const SimulationState&)> told_;
  WorkQueue<Item> queue_;
  std::atomic<bool> stopping_{false};
  std::atomic<unsigned> generation_{0};  // incremented by reset(), under the mutex

  mutable std::mutex mutex_;  // guards the members below
  SimulationDrift drift_;
  std::optional<SimulationState> last_;

  std::thread thread_;  // declared last: it starts when all other members exist
};

}  // namespace uncertainty_identification
