#pragma once

#include <Eigen/Core>
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
  bool is_mirrored = false;  ///< turned half round zero: another gain below zero, not above it
  /// To begin with: the shape's own parameters, behind 1 + its amplitude unless the shape is whole.
  Eigen::VectorXd start;
};

/// The shapes that are tried around a simulation, each with all its starts. `input` and `output`
/// are the root mean squares of its signals.
std::vector<PlacedShape> shapesAround(double input, double output);

/// What comes out of the shape: the signal, or the factor, that replaces `signal`.
Eigen::VectorXd shaped(const PlacedShape& placed, const Eigen::VectorXd& signal,
                       const Eigen::VectorXd& parameters);

/// A simulation, which must outlive it, with a shape around it. Its parameters are those of the
/// shape; those of the simulation keep their own values. Where the simulation gives numbers that
/// are not finite for the changed input, the output is as far off as can be.
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
