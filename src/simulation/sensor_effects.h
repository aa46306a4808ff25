#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

/// Effects between the plant's output and the record, for a truth to hide. `wiener` and a clip
/// before the noise act on x, bias, drift and hum add to it, then come the noise and the others.
namespace uncertainty_identification {

/// x + quadratic x^2 + cubic x^3.
struct WienerTruth {
  double quadratic = 0.1;  ///< [1/unit of y]
  double cubic = 0;        ///< [1/unit of y, squared]
};

/// y + b, b the same for all experiments or drawn for each.
struct BiasTruth {
  double bias = 0.1;            ///< [unit of y] of all experiments
  bool per_experiment = false;  ///< b_r ~ N(0, deviation^2) instead
  double deviation = 0.1;       ///< [unit of y], 0 or above
};

/// y + s t/N, s the same for all experiments or drawn for each.
struct SensorDriftTruth {
  double drift = 0.5;           ///< [unit of y] over an experiment
  bool per_experiment = false;  ///< s_r ~ N(0, deviation^2) instead
  double deviation = 0.5;       ///< [unit of y], 0 or above
};

/// y + amplitude sin(frequency t + phase).
struct HumTruth {
  double amplitude = 0.1;       ///< [unit of y], 0 or above
  double frequency = 0.5;       ///< [rad/sample], 0 to pi
  double phase = 0;             ///< [rad] at the first sample of all experiments
  bool per_experiment = false;  ///< a phase drawn for each instead, any equally likely
};

/// (1 - pole)/(1 - pole q^-1) of what is measured, the noise included, from rest.
struct SensorLagTruth {
  double pole = 0.5;  ///< between -1 and 1
};

/// Some samples are off by o ~ N(0, size^2).
struct OutliersTruth {
  double probability = 0.01;  ///< per sample; at least 0 and below 1
  double size = 1;            ///< [unit of y], 0 or above
};

/// The measurement within +- limit.
struct ClipTruth {
  double limit = 1;           ///< [unit of y], above 0
  bool before_noise = false;  ///< the noise enters behind the clip
};

/// step round(y/step).
struct SensorQuantisationTruth {
  double step = 0.5;  ///< [unit of y], above 0
};

/// Some samples repeat the one recorded before.
struct DropoutTruth {
  double probability = 0.05;  ///< per sample; at least 0 and below 1
};

struct SensorEffects {
  std::optional<WienerTruth> wiener;
  std::optional<BiasTruth> bias;
  std::optional<SensorDriftTruth> drift;
  std::optional<HumTruth> hum;
  std::optional<SensorLagTruth> lag;
  std::optional<OutliersTruth> outliers;
  std::optional<ClipTruth> clip;
  std::optional<SensorQuantisationTruth> quant;
  std::optional<DropoutTruth> dropout;

  void validate() const;
};

}  // namespace uncertainty_identification
