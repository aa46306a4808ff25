#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "curves/shape.h"
#include "uncertainty_identification/own_simulation/simulation.h"

namespace uncertainty_identification {

/// A shape before or behind a simulation: of its input, of its output, or of time (0 to 1 over an
/// experiment) by which the input is multiplied.
struct PlacedShape {
  Place place = Place::input;  ///< or sensor, time_gain
  const Shape* shape = nullptr;
  double unit = 1;           ///< root mean square of the signal, in whose units the shape counts
  bool is_mirrored = false;  ///< turned half round zero: another gain for the negative sign
  /// To begin with: the shape's own parameters, behind an amplitude of 0 unless the shape is whole.
  Eigen::VectorXd start;
};

/// The shapes that are tried around a simulation, each with all its starts. `input` and `output`
/// are the root mean squares of its signals; `acts_on_input`: whether it can be run with another
/// input.
std::vector<PlacedShape> shapesAround(double input, double output, bool acts_on_input);

/// What comes out of the shape: the signal, or the factor, that replaces `signal`.
Eigen::VectorXd shaped(const PlacedShape& placed, const Eigen::VectorXd& signal,
                       const Eigen::VectorXd& parameters);

/// A simulation, which must outlive it, at its own values, each input of which is run once.
class KeptSimulation : public Simulation {
 public:
  explicit KeptSimulation(Simulation& simulation);

  std::string description() const override { return simulation_.description(); }
  std::vector<SimulationParameter> parameters() const override { return {}; }
  bool canRerun() const override { return false; }
  Eigen::VectorXd run(const SimulationInput& input, const Eigen::VectorXd& values) override;

  /// How often the simulation was run.
  int count() const { return static_cast<int>(outputs_.size()); }

 private:
  Simulation& simulation_;
  const Eigen::VectorXd own_values_;
  std::map<std::vector<double>, Eigen::VectorXd> outputs_;  ///< by the input
};

/// A simulation, which must outlive it, with a shape around it. Its parameters are those of the
/// shape; those of the simulation keep their own values.
class ShapedSimulation : public Simulation {
 public:
  ShapedSimulation(Simulation& simulation, PlacedShape placed);

  std::string description() const override { return simulation_.description(); }
  std::vector<SimulationParameter> parameters() const override;
  bool canRerun() const override { return simulation_.canRerun(); }
  Eigen::VectorXd run(const SimulationInput& input, const Eigen::VectorXd& values) override;

  const PlacedShape& placed() const { return placed_; }

 private:
  Simulation& simulation_;
  const PlacedShape placed_;
  const Eigen::VectorXd own_values_;
};

}  // namespace uncertainty_identification
