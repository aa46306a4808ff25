#pragma once

#include <Eigen/Core>
#include <optional>

#include "simulation/field.h"

/// Effects of the actuator: they change the recorded input before it reaches the plant.
namespace uncertainty_identification {

/// Adds a constant to the input.
struct ActuatorOffsetTruth {
  double offset = 0.1;  ///< [unit of u]
  Fields fields() { return {{"offset", &offset}}; }
};

/// Delays the input, linear between samples. Before its first sample the input is 0.
struct ActuatorDelayTruth {
  double delay = 1;  ///< [samples]
  Fields fields() { return {{"delay", &delay, range::kNotNegative}}; }
};

/// Rounds the input to the nearest multiple of `step`.
struct ActuatorQuantisationTruth {
  double step = 0.5;  ///< [unit of u]
  Fields fields() { return {{"step", &step, range::kPositive}}; }
};

/// Dead zone: 0 while the input is within the zone, else the input's distance from its edge.
struct DeadZoneTruth {
  double width = 0.2;                    ///< [unit of u], of positive inputs
  std::optional<double> negative_width;  ///< [unit of u], of negative inputs; absent: `width`
  Fields fields() {
    return {{"width", &width, range::kNotNegative},
            {"negative_width", &negative_width, range::kNotNegative}};
  }
};

/// Play of a gear: the output follows the input at a distance of half the width, and rests while
/// the input turns round.
struct BacklashTruth {
  double width = 0.2;  ///< [unit of u]
  Fields fields() { return {{"width", &width, range::kNotNegative}}; }
};

/// The output follows the input by at most `rate` per sample. It starts at 0.
struct RateLimitTruth {
  double rate = 0.5;  ///< [unit of u per sample]
  Fields fields() { return {{"rate", &rate, range::kPositive}}; }
};

/// Limits the input to -limit ... limit.
struct SaturationTruth {
  double limit = 1;  ///< [unit of u]
  Fields fields() { return {{"limit", &limit, range::kPositive}}; }
};

/// Static nonlinearity u + quadratic u^2 + cubic u^3.
struct HammersteinTruth {
  double quadratic = 0.1;  ///< [1/unit of u]
  double cubic = 0;        ///< [1/unit of u, squared]
  Fields fields() { return {{"quadratic", &quadratic}, {"cubic", &cubic}}; }
};

/// From the time `start` on the input is multiplied by 1 - loss. When `start` lies between the
/// samples k and k + 1, sample k already loses the part k + 1 - start of it.
struct LossTruth {
  double loss = 0.3;
  double start = 150;  ///< [samples] since the experiment began
  Fields fields() { return {{"loss", &loss, range::kAtMostOne}, {"start", &start}}; }
};

/// Each effect is absent or has its parameters. They act in the order in which they stand here.
struct ActuatorEffects {
  std::optional<ActuatorOffsetTruth> offset;
  std::optional<ActuatorDelayTruth> delay;
  std::optional<ActuatorQuantisationTruth> quantisation;
  std::optional<DeadZoneTruth> deadzone;
  std::optional<BacklashTruth> backlash;
  std::optional<RateLimitTruth> ratelimit;
  std::optional<SaturationTruth> saturation;
  std::optional<HammersteinTruth> hammerstein;
  std::optional<LossTruth> loss;
};

/// The signal that reaches the plant when the recorded input is u.
Eigen::VectorXd actuated(const ActuatorEffects& effects, Eigen::VectorXd u);

}  // namespace uncertainty_identification
