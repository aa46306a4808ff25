#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

/// Effects inside the plant, for a truth to hide. x is the plant's output [unit of y], f what
/// drives its linear part: x = q^-delay B/A f with f = u, unless an effect feeds x back into f.
namespace uncertainty_identification {

/// A further pole: (1 - pole)/(1 - pole q^-1) x.
struct PlantPoleTruth {
  double pole = 0.5;  ///< between -1 and 1
};

/// A mode in parallel to Go: (g1 q^-1 + g2 q^-2)/(1 - 2 radius cos(frequency) q^-1 + radius^2
/// q^-2).
struct ResonanceTruth {
  double radius = 0.95;     ///< of the pole pair, at least 0 and below 1
  double frequency = 1;     ///< [rad/sample] of the pole pair, 0 to pi
  double g1 = 0.1, g2 = 0;  ///< [unit of y/unit of u]
};

/// f = u - coefficient x^3: a spring that hardens.
struct CubicTruth {
  double coefficient = 0.1;  ///< [unit of u/unit of y, cubed]
};

/// f = u - friction tanh((x(t) - x(t - 1))/smoothing).
struct CoulombTruth {
  double friction = 0.1;   ///< [unit of u], 0 or above
  double smoothing = 0.1;  ///< [unit of y per sample], above 0
};

/// Gain 1 + slope (t/N - 1/2).
struct GainDriftTruth {
  double slope = 0.5;  ///< change of the relative gain over an experiment
};

/// The mean of xi moves by shift (r/(M - 1) - 1/2) over the experiments r = 0..M-1.
struct AgingTruth {
  Eigen::VectorXd shift = Eigen::VectorXd::Constant(1, 0.5);  ///< from the first to the last; n
};

/// Gain 1 + coefficient (temp - reference)/10, with the covariate `temp`.
struct TemperatureGainTruth {
  double coefficient = 0.1;  ///< [1 per 10 units of temp]
  double reference = 20;     ///< [unit of temp]
};

/// x += c_r times the impulse response of 1/A, c_r ~ N(0, deviation^2) per experiment.
struct InitialStateTruth {
  double deviation = 1;  ///< [unit of y], 0 or above
};

/// A parameter of Go is theta_j (1 + d_r), d_r ~ N(0, deviation^2) per experiment, drawn anew where
/// the plant were not stable.
struct ParameterSpreadTruth {
  std::string parameter = "b1";  ///< b1.., a1..; first_order: time_constant, gain
  double deviation = 0.1;        ///< relative, 0 or above
};

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

  void validate() const;
};

}  // namespace uncertainty_identification
