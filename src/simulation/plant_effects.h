#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

#include "simulation/field.h"

/// Effects of the plant. x is its output [unit of y] and f the input of its linear part:
/// x = q^-delay B/A f. f is the actuator's output u, unless an effect feeds x back into f.
namespace uncertainty_identification {

/// Filters the plant's output by a further pole: (1 - pole)/(1 - pole q^-1) x.
struct PlantPoleTruth {
  double pole = 0.5;
  Fields fields() { return {{"pole", &pole, range::kInsideCircle}}; }
};

/// A resonance in parallel to Go, which adds
/// (g1 q^-1 + g2 q^-2)/(1 - 2 radius cos(frequency) q^-1 + radius^2 q^-2) u to x.
struct ResonanceTruth {
  double radius = 0.95;     ///< of the pair of poles
  double frequency = 1;     ///< [rad/sample] of the pair of poles
  double g1 = 0.1, g2 = 0;  ///< [unit of y/unit of u]
  Fields fields() {
    return {{"radius", &radius, range::kBelowOne},
            {"frequency", &frequency, range::kZeroToPi},
            {"g1", &g1},
            {"g2", &g2}};
  }
};

/// A hardening spring: f = u - coefficient x^3.
struct CubicTruth {
  double coefficient = 0.1;  ///< [unit of u/unit of y, cubed]
  Fields fields() { return {{"coefficient", &coefficient}}; }
};

/// Coulomb friction: f = u - friction tanh((x(t) - x(t - 1))/smoothing).
struct CoulombTruth {
  double friction = 0.1;   ///< [unit of u]
  double smoothing = 0.1;  ///< [unit of y per sample]
  Fields fields() {
    return {{"friction", &friction, range::kNotNegative},
            {"smoothing", &smoothing, range::kPositive}};
  }
};

/// The gain changes within each experiment: it is multiplied by 1 + slope (t/N - 1/2).
struct GainDriftTruth {
  double slope = 0.5;
  Fields fields() { return {{"slope", &slope}}; }
};

/// The plant changes from experiment to experiment: the mean of xi moves by
/// shift (r/(M - 1) - 1/2) over the experiments r = 0..M-1.
struct AgingTruth {
  Eigen::VectorXd shift = Eigen::VectorXd::Constant(1, 0.5);  ///< one entry for each entry of xi
  Fields fields() { return {{"shift", &shift}}; }
};

/// The gain depends on the covariate `temp`: it is multiplied by
/// 1 + coefficient (temp - reference)/10.
struct TemperatureGainTruth {
  double coefficient = 0.1;  ///< [1 per 10 units of temp]
  double reference = 20;     ///< [unit of temp]
  Fields fields() { return {{"coefficient", &coefficient}, {"reference", &reference}}; }
};

/// The plant does not start at rest: c_r times the impulse response of 1/A is added to x, where
/// c_r ~ N(0, deviation^2) is drawn for each experiment.
struct InitialStateTruth {
  double deviation = 1;  ///< [unit of y]
  Fields fields() { return {{"deviation", &deviation, range::kNotNegative}}; }
};

/// A parameter of Go differs between experiments: it is theta_j (1 + d_r) with
/// d_r ~ N(0, deviation^2). When the plant would be unstable, d_r is drawn again.
struct ParameterSpreadTruth {
  std::string parameter = "b1";  ///< b1.., a1..; of a first_order plant time_constant or gain
  double deviation = 0.1;        ///< relative
  Fields fields() {
    return {{"parameter", &parameter}, {"deviation", &deviation, range::kNotNegative}};
  }
};

/// Each effect is absent or has its parameters.
struct PlantEffects {
  std::optional<PlantPoleTruth> pole;
  std::optional<ResonanceTruth> resonance;
  std::optional<CubicTruth> cubic;
  std::optional<CoulombTruth> coulomb;
  std::optional<GainDriftTruth> drift;
  std::optional<AgingTruth> aging;
  std::optional<TemperatureGainTruth> temp;
  std::optional<InitialStateTruth> init;
  std::optional<ParameterSpreadTruth> parameter_spread;
};

}  // namespace uncertainty_identification
