#pragma once

#include <memory>
#include <optional>

#include "own_simulation/compared_runs.h"
#include "uncertainty_identification/curves/simulation_causes.h"
#include "uncertainty_identification/own_simulation/extension.h"

namespace uncertainty_identification {

/// A curve that acts before a simulation or on its output.
struct SurroundingCurve {
  OwnCurve curve;
  /// Whether its scale means something, as that of a dead zone, whose slope is 1. Otherwise the
  /// linear plant beside which it was found shares scale and offset with it: those of the value
  /// before the plant, those of what goes in behind it.
  bool is_to_scale = false;
};

/// The curve of a cause that acts on the input, by a factor on the input that depends on time or on
/// a covariate, or on the output. Nothing for those that act inside the plant.
std::optional<SurroundingCurve> surroundingCurve(const SimulationCause& cause);

/// The values of a curve.
Eigen::VectorXd valuesAt(const OwnCurve& curve, const Eigen::VectorXd& signal);

/// The simulation, which must outlive it, with the curve around it.
std::unique_ptr<Simulation> withCurve(Simulation& simulation, const OwnCurve& curve);

/// The curve with the scale, and for curves of input and output the offset, that suit this
/// simulation best. Needs at most `most` runs; the number of them is added to `count`.
OwnCurve scaledTo(Simulation& simulation, const OwnCurve& curve, const ComparedData& data, int most,
                  const std::function<bool(int)>& keep_going, int* count);

}  // namespace uncertainty_identification
