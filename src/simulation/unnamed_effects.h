#pragma once

#include <optional>

/// Effects that no catalogue holds, for a truth to hide: the answer to them is `unknown`.
namespace uncertainty_identification {

/// The gain is 1 + depth or 1 - depth and switches at random.
struct TelegraphTruth {
  double depth = 0.3;
  double probability = 0.02;  ///< of switching, per sample; at least 0 and below 1
};

/// f = u + coefficient u x in the loop of the plant (plant_effects.h).
struct BilinearTruth {
  double coefficient = 0.1;  ///< [1/unit of y]
};

/// f = u - torque sin(x/angle): a pendulum's gravity.
struct GravityTruth {
  double torque = 0.1;  ///< [unit of u]
  double angle = 1;     ///< [unit of y per rad], above 0
};

/// f = u - coefficient sign(x) sqrt|x|: the outflow of a tank.
struct OutflowTruth {
  double coefficient = 0.1;  ///< [unit of u/root of the unit of y]
};

/// (1 - share) x + share |x|: a sensor that rectifies.
struct RectificationTruth {
  double share = 0.3;
};

/// Bursts that begin at random and ring down are added to the output.
struct BurstTruth {
  double amplitude = 1;       ///< [unit of y] standard deviation of a burst's first value
  double probability = 0.01;  ///< of a burst's beginning, per sample; at least 0 and below 1
  double frequency = 1;       ///< [rad/sample]
  double radius = 0.9;        ///< decay per sample; at least 0 and below 1
};

struct UnnamedEffects {
  std::optional<TelegraphTruth> telegraph;
  std::optional<BilinearTruth> bilinear;
  std::optional<GravityTruth> gravity;
  std::optional<OutflowTruth> outflow;
  std::optional<RectificationTruth> rectification;
  std::optional<BurstTruth> burst;

  void validate() const;
};

}  // namespace uncertainty_identification
