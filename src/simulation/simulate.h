#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "simulation/truth.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// The random numbers that the effects of a truth drew for one experiment; 0 for an absent effect.
struct EffectDraws {
  double parameter_deviation = 0;  ///< plant_parameter_spread: relative
  double initial_state = 0;        ///< plant_init: c_r [unit of y]
  double bias = 0;                 ///< sens_bias per experiment [unit of y]
  double drift = 0;                ///< sens_drift per experiment [unit of y]
  double hum_phase = 0;            ///< sens_hum per experiment [rad]
  double clock_shift = 0;          ///< exp_clock: tau_r [samples]
};

/// The system on which one experiment was made.
struct DrawnSystem {
  Polynomials polynomials;              ///< of this experiment's plant and of the noise
  std::optional<double> time_constant;  ///< tau [s] of a first_order plant
  std::optional<int> component;  ///< of the mixture from which xi was drawn, counted from 0; that
                                 ///< of exp_mode follows the last; absent without an error model
  Eigen::VectorXd xi;            ///< free parameters of the relative error
  EffectDraws effects;
};

/// The id of experiment r (from 0), e.g. "exp_000007".
std::string experimentId(int r);

/// The system of experiment r (from 0). It depends on the truth, the seed and r alone, and only
/// with plant_aging also on the number of experiments.
DrawnSystem drawSystem(const Truth& truth, std::uint64_t seed, int r);

/// Simulates experiment r (from 0). It does not depend on the number of experiments, except with
/// plant_aging. The first experiment starts at 1 s and the others follow with pauses of ten
/// samples. Outputs that are not measured are NaN and marked as not valid. Throws
/// ConfigurationError when an effect makes the output diverge.
Experiment simulateExperiment(const Truth& truth, std::uint64_t seed, int r);

/// Simulates all experiments of a truth. Throws ConfigurationError when the truth is not valid.
std::vector<Experiment> simulate(const Truth& truth, std::uint64_t seed);

}  // namespace uncertainty_identification
