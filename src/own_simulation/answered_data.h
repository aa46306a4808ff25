#pragma once

#include <string>
#include <vector>

#include "own_simulation/compared_runs.h"

namespace uncertainty_identification {

/// A simulation, which must outlive it, that counts its runs.
class CountedSimulation : public Simulation {
 public:
  explicit CountedSimulation(Simulation& simulation) : simulation_(simulation) {}
  std::string description() const override { return simulation_.description(); }
  std::vector<SimulationParameter> parameters() const override { return simulation_.parameters(); }
  bool canRerun() const override { return simulation_.canRerun(); }
  Eigen::VectorXd run(const SimulationInput& input, const Eigen::VectorXd& values) override {
    ++count_;
    return simulation_.run(input, values);
  }
  int count() const { return count_; }

 private:
  Simulation& simulation_;
  int count_ = 0;
};

/// The experiments with the answer of the simulation as a signal, by which a shape behind it is
/// tried without running it again.
class Answered {
 public:
  Answered(const ComparedData& data, SimulationRuns* runs) {
    for (const ComparedRun& run : data.runs) {
      experiments_.push_back(*run.experiment);
      experiments_.back().signals = {{kSignal, runs->output(run, runs->ownValues())}};
    }
    data_ = data;
    for (std::size_t k = 0; k < experiments_.size(); ++k)
      data_.runs[k].experiment = &experiments_[k];
  }
  Answered(const Answered&) = delete;
  Answered& operator=(const Answered&) = delete;

  static constexpr const char* kSignal = "answer";
  const ComparedData& data() const { return data_; }

 private:
  std::vector<Experiment> experiments_;
  ComparedData data_;
};

}  // namespace uncertainty_identification
