#include "fmu/fmu_simulation.h"

#include <limits>
#include <utility>

#include "fmu/fmu_instance.h"
#include "fmu/unpacked_fmu.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

class FmuSimulation : public Simulation {
 public:
  FmuSimulation(const std::string& path, const FmuSignals& signals)
      : path_(path), fmu_(path), library_(fmu_.library()), steps_(signals.steps_per_sample) {
    const ModelDescription& known = fmu_.description();
    input_ = known.variable("input", signals.input, "input").reference;
    output_ = known.variable("output", signals.output, "output").reference;
    for (const auto& [name, value] : signals.parameters) {
      const FmuVariable& variable = known.variable("parameters", name, "parameter");
      parameters_.push_back({name, value, variable.unit});
      references_.push_back(variable.reference);
    }
  }

  std::string description() const override { return "the FMU " + path_; }
  std::vector<SimulationParameter> parameters() const override { return parameters_; }
  bool canRerun() const override { return true; }

  Eigen::VectorXd run(const SimulationInput& input, const Eigen::VectorXd& values) override {
    Eigen::VectorXd y =
        Eigen::VectorXd::Constant(input.u.size(), std::numeric_limits<double>::quiet_NaN());
    try {
      simulate(input, values, &y);
    } catch (const DataError& error) {
      if (isOwn(values) && input.measured_u.size() == 0)
        throw DataError(description() + ": " + error.what());
    }
    return y;
  }

 private:
  bool isOwn(const Eigen::VectorXd& values) const {
    for (std::size_t k = 0; k < parameters_.size(); ++k)
      if (values[static_cast<Eigen::Index>(k)] != parameters_[k].value) return false;
    return true;
  }

  void simulate(const SimulationInput& input, const Eigen::VectorXd& values, Eigen::VectorXd* y) {
    const auto instance =
        makeInstance({library_, fmu_.description(), fmu_.folder() + "/resources", steps_});
    for (std::size_t k = 0; k < references_.size(); ++k)
      instance->set(references_[k], values[static_cast<Eigen::Index>(k)]);
    if (input.u.size() > 0) instance->set(input_, input.u[0]);
    instance->initialise();
    for (Eigen::Index k = 0; k < input.u.size(); ++k) {
      instance->set(input_, input.u[k]);
      (*y)[k] = instance->get(output_);
      if (k + 1 < input.u.size())
        instance->step(static_cast<double>(k) * input.sample_time, input.sample_time);
    }
  }

  const std::string path_;
  const UnpackedFmu fmu_;
  const FmuLibrary library_;
  const int steps_;
  unsigned int input_ = 0, output_ = 0;
  std::vector<SimulationParameter> parameters_;
  std::vector<unsigned int> references_;
};

}  // namespace

std::unique_ptr<Simulation> loadFmu(const std::string& path, const FmuSignals& signals) {
  return std::make_unique<FmuSimulation>(path, signals);
}

}  // namespace uncertainty_identification
