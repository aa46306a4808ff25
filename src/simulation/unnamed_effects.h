#pragma once

#include <optional>

#include "simulation/field.h"

/// Effects that are not in the catalogue of explain(), which should answer `unknown` to them.
namespace uncertainty_identification {

/// The gain switches at random between 1 + depth and 1 - depth times its value.
struct TelegraphTruth {
  double depth = 0.3;
  double probability = 0.02;  ///< that the gain switches at a sample
  Fields fields() { return {{"depth", &depth}, {"probability", &probability, range::kBelowOne}}; }
};

/// The input of the linear part is f = u + coefficient u x (see plant_effects.h).
struct BilinearTruth {
  double coefficient = 0.1;  ///< [1/unit of y]
  Fields fields() { return {{"coefficient", &coefficient}}; }
};

/// Gravity on a pendulum: f = u - torque sin(x/angle).
struct GravityTruth {
  double torque = 0.1;  ///< [unit of u]
  double angle = 1;     ///< [unit of y per rad]
  Fields fields() { return {{"torque", &torque}, {"angle", &angle, range::kPositive}}; }
};

/// Outflow of a tank: f = u - coefficient sign(x) sqrt|x|.
struct OutflowTruth {
  double coefficient = 0.1;  ///< [unit of u/root of the unit of y]
  Fields fields() { return {{"coefficient", &coefficient}}; }
};

/// A sensor that rectifies: (1 - share) x + share |x|.
struct RectificationTruth {
  double share = 0.3;
  Fields fields() { return {{"share", &share}}; }
};

/// Adds oscillations to the output that begin at random times and decay.
struct BurstTruth {
  double amplitude = 1;       ///< [unit of y] standard deviation of an oscillation's first value
  double probability = 0.01;  ///< that an oscillation begins at a sample
  double frequency = 1;       ///< [rad/sample]
  double radius = 0.9;        ///< factor by which the oscillation decays per sample
  Fields fields() {
    return {{"amplitude", &amplitude},
            {"probability", &probability, range::kBelowOne},
            {"frequency", &frequency, range::kZeroToPi},
            {"radius", &radius, range::kBelowOne}};
  }
};

/// Each effect is absent or has its parameters.
struct UnnamedEffects {
  std::optional<TelegraphTruth> telegraph;
  std::optional<BilinearTruth> bilinear;
  std::optional<GravityTruth> gravity;
  std::optional<OutflowTruth> outflow;
  std::optional<RectificationTruth> rectification;
  std::optional<BurstTruth> burst;
};

}  // namespace uncertainty_identification
