#pragma once

#include <Eigen/Core>
#include <optional>

/// Effects between the recorded input and the plant, for a truth to hide: each is absent or has
/// parameters, and the order of declaration is the order in which they act.
namespace uncertainty_identification {

/// u + offset.
struct ActuatorOffsetTruth {
  double offset = 0.1;  ///< [unit of u]
};

/// u(t - delay), linear between samples; nothing before the first one.
struct ActuatorDelayTruth {
  double delay = 1;  ///< [samples], 0 or above
};

/// step round(u/step).
struct ActuatorQuantisationTruth {
  double step = 0.5;  ///< [unit of u], above 0
};

/// The input less the width of its sign; zero within.
struct DeadZoneTruth {
  double width = 0.2;                    ///< [unit of u], 0 or above
  std::optional<double> negative_width;  ///< [unit of u] of negative inputs; absent: the same
};

/// Play: the output follows at the distance of half the width, and rests while the input turns.
struct BacklashTruth {
  double width = 0.2;  ///< [unit of u], 0 or above
};

/// The output follows the input by at most `rate` per sample, from 0.
struct RateLimitTruth {
  double rate = 0.5;  ///< [unit of u per sample], above 0
};

/// The input within +- limit.
struct SaturationTruth {
  double limit = 1;  ///< [unit of u], above 0
};

/// u + quadratic u^2 + cubic u^3.
struct HammersteinTruth {
  double quadratic = 0.1;  ///< [1/unit of u]
  double cubic = 0;        ///< [1/unit of u, squared]
};

/// From `start` on the actuator has lost a share of its effect; a start between two samples loses
/// the share's part at the earlier one.
struct LossTruth {
  double loss = 0.3;   ///< share, at most 1
  double start = 150;  ///< [samples] since the experiment began
};

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

  void validate() const;
};

/// What reaches the plant of the input u.
Eigen::VectorXd actuated(const ActuatorEffects& effects, Eigen::VectorXd u);

}  // namespace uncertainty_identification
