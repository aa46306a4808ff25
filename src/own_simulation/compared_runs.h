#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "uncertainty_identification/own_simulation/simulation.h"

namespace uncertainty_identification {

/// An experiment, or a part of one, that a simulation is compared to.
struct ComparedRun {
  const Experiment* experiment = nullptr;
  Eigen::ArrayXd weight;    ///< N, 1 = compared, 0 = missing or not in this part
  std::vector<int> blocks;  ///< where each independent unit begins, and the end
};

struct ComparedData {
  std::vector<ComparedRun> runs;

  int samples() const;                       ///< compared ones
  double power() const;                      ///< squared deviation of the output from its mean
  double fitOf(double squared_error) const;  ///< [%] 100 (1 - |error| / |y - mean|)
};

/// The part [begin, end) of each experiment, as shares of its length. The experiments are the
/// independent units; of few experiments each is divided, so that there are at least ten.
ComparedData comparedData(const std::vector<Experiment>& experiments, double begin, double end);

/// Runs a simulation over experiments, no more often than is allowed, and keeps what it gave.
class SimulationRuns {
 public:
  /// `keep_going` is called before each run with the number of runs so far; false cancels.
  SimulationRuns(Simulation& simulation, int most, std::function<bool(int)> keep_going)
      : simulation_(simulation), most_(most), keep_going_(std::move(keep_going)) {}

  const std::vector<SimulationParameter>& parameters() const { return parameters_; }
  const Eigen::VectorXd& ownValues() const { return own_values_; }

  /// The output for values of the parameters. Throws DataError where the simulation fails, returns
  /// another number of samples, or numbers that are not finite at its own values.
  const Eigen::VectorXd& output(const ComparedRun& run, const Eigen::VectorXd& values);

  /// Whether so many further runs are allowed. Once false, or cancelled, endedEarly() stays true.
  bool affords(std::size_t further);
  bool endedEarly() const { return ended_early_ || cancelled_; }
  bool cancelled() const { return cancelled_; }
  /// Allows so many runs in all, and to go on unless it was cancelled.
  void allow(int most);
  int count() const { return count_; }

 private:
  using Key = std::pair<const Experiment*, std::vector<double>>;

  Simulation& simulation_;
  int most_;
  std::function<bool(int)> keep_going_;
  const std::vector<SimulationParameter> parameters_ = simulation_.parameters();
  const Eigen::VectorXd own_values_ = valuesOf(parameters_);
  std::map<Key, Eigen::VectorXd> kept_;
  std::size_t kept_samples_ = 0;
  int count_ = 0;
  bool ended_early_ = false, cancelled_ = false;

  static Eigen::VectorXd valuesOf(const std::vector<SimulationParameter>& parameters);
};

}  // namespace uncertainty_identification
