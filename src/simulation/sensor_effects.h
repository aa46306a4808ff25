#pragma once

#include <optional>

#include "simulation/field.h"

/// Effects of the sensor. `wiener` and a clip before the noise change the plant's output x. Bias,
/// drift, hum and then the noise are added. The other effects change the sum.
namespace uncertainty_identification {

/// Static nonlinearity x + quadratic x^2 + cubic x^3.
struct WienerTruth {
  double quadratic = 0.1;  ///< [1/unit of y]
  double cubic = 0;        ///< [1/unit of y, squared]
  Fields fields() { return {{"quadratic", &quadratic}, {"cubic", &cubic}}; }
};

/// Adds a constant, either the same one in all experiments or one drawn for each.
struct BiasTruth {
  double bias = 0.1;            ///< [unit of y] of all experiments
  bool per_experiment = false;  ///< draw it from N(0, deviation^2) for each experiment instead
  double deviation = 0.1;       ///< [unit of y]
  Fields fields() {
    return {{"bias", &bias},
            {"per_experiment", &per_experiment},
            {"deviation", &deviation, range::kNotNegative}};
  }
};

/// Adds a ramp that starts at 0, either the same one in all experiments or one drawn for each.
struct SensorDriftTruth {
  double drift = 0.5;           ///< [unit of y] from beginning to end, of all experiments
  bool per_experiment = false;  ///< draw it from N(0, deviation^2) for each experiment instead
  double deviation = 0.5;       ///< [unit of y]
  Fields fields() {
    return {{"drift", &drift},
            {"per_experiment", &per_experiment},
            {"deviation", &deviation, range::kNotNegative}};
  }
};

/// Adds amplitude sin(frequency t + phase), for example the hum of the mains.
struct HumTruth {
  double amplitude = 0.1;       ///< [unit of y]
  double frequency = 0.5;       ///< [rad/sample]
  double phase = 0;             ///< [rad] at the first sample of all experiments
  bool per_experiment = false;  ///< draw the phase uniformly for each experiment instead
  Fields fields() {
    return {{"amplitude", &amplitude, range::kNotNegative},
            {"frequency", &frequency, range::kZeroToPi},
            {"phase", &phase},
            {"per_experiment", &per_experiment}};
  }
};

/// A slow sensor: filters output and noise by (1 - pole)/(1 - pole q^-1), starting at rest.
struct SensorLagTruth {
  double pole = 0.5;
  Fields fields() { return {{"pole", &pole, range::kInsideCircle}}; }
};

/// Adds an error from N(0, size^2) to a few samples, which are chosen at random.
struct OutliersTruth {
  double probability = 0.01;  ///< that a sample is an outlier
  double size = 1;            ///< [unit of y]
  Fields fields() {
    return {{"probability", &probability, range::kBelowOne}, {"size", &size, range::kNotNegative}};
  }
};

/// Limits the measurement to -limit ... limit.
struct ClipTruth {
  double limit = 1;           ///< [unit of y]
  bool before_noise = false;  ///< limit x, so that the noise is added to the limited signal
  Fields fields() { return {{"limit", &limit, range::kPositive}, {"before_noise", &before_noise}}; }
};

/// Rounds the measurement to the nearest multiple of `step`.
struct SensorQuantisationTruth {
  double step = 0.5;  ///< [unit of y]
  Fields fields() { return {{"step", &step, range::kPositive}}; }
};

/// Some samples are lost: the record repeats the sample before them.
struct DropoutTruth {
  double probability = 0.05;  ///< that a sample is lost
  Fields fields() { return {{"probability", &probability, range::kBelowOne}}; }
};

/// Each effect is absent or has its parameters.
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
};

}  // namespace uncertainty_identification
