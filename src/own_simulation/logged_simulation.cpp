#include "own_simulation/logged_simulation.h"

#include <utility>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

class LoggedSimulation : public Simulation {
 public:
  LoggedSimulation(std::string name, std::string description)
      : name_(std::move(name)), description_(std::move(description)) {}

  std::string description() const override { return description_; }
  std::vector<SimulationParameter> parameters() const override { return {}; }
  bool canRerun() const override { return false; }

  Eigen::VectorXd run(const SimulationInput& input, const Eigen::VectorXd& /*values*/) override {
    if (const auto signal = input.signals.find(name_); signal != input.signals.end())
      return signal->second;
    const auto constant = input.scalars.find(name_);
    if (constant != input.scalars.end())
      return Eigen::VectorXd::Constant(input.u.size(), constant->second);
    throw DataError(description_ +
                    ": an experiment does not hold it; log the simulation's output in every "
                    "experiment");
  }

 private:
  std::string name_, description_;
};

}  // namespace

std::unique_ptr<Simulation> makeLoggedSimulation(const std::string& name,
                                                 const std::string& description) {
  return std::make_unique<LoggedSimulation>(name, description);
}

std::vector<Experiment> withoutSignal(std::vector<Experiment> experiments,
                                      const std::string& name) {
  for (Experiment& experiment : experiments) {
    experiment.signals.erase(name);
    experiment.scalars.erase(name);
  }
  return experiments;
}

}  // namespace uncertainty_identification
