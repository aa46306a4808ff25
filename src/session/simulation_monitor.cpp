#include "session/simulation_monitor.h"

#include <utility>

namespace uncertainty_identification {

SimulationMonitor::SimulationMonitor(std::string signal,
                                     std::function<void(const SimulationState&)> told)
    : signal_(std::move(signal)), told_(std::move(told)), thread_([this] { run(); }) {}

SimulationMonitor::~SimulationMonitor() {
  stopping_ = true;
  queue_.close();
  thread_.join();
}

void SimulationMonitor::add(std::shared_ptr<const Experiment> experiment) {
  queue_.push({generation_, std::move(experiment)});
}

void SimulationMonitor::reset() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++generation_;
  drift_ = {};
  last_.reset();
}

std::optional<SimulationState> SimulationMonitor::last() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return last_;
}

void SimulationMonitor::run() {
  for (auto items = queue_.takeAll(); !items.empty(); items = queue_.takeAll())
    for (const Item& item : items)
      if (!stopping_ && item.generation == generation_) compare(item);
}

void SimulationMonitor::compare(const Item& item) {
  const std::optional<SimulationErrors> errors = simulationErrors(*item.experiment, signal_);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (item.generation != generation_) return;
  if (!last_) last_.emplace();
  last_->missing_in = errors ? "" : item.experiment->id;
  if (!errors) return;
  drift_.add(*errors);
  last_->errors = *errors;
  last_->drift = drift_.decision();
  told_(*last_);
}

}  // namespace uncertainty_identification
