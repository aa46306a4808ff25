#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "simulation/truth.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// What the effects of a truth drew for one experiment; 0 where an effect is absent.
struct EffectDraws {
  double parameter_deviation = 0;  ///< plant_parameter_spread: relative
  double initial_state = 0;        ///< plant_init: c_r [unit of y]
  double bias = 0;                 ///< sens_bias per experiment [unit of y]
  double drift = 0;                ///< sens_drift per experiment [unit of y]
  double hum_phase = 0;            ///< sens_hum per experiment [rad]
  double clock_shift = 0;          ///< exp_clock: tau_r [samples]
};

/// The system that one experiment was made with.
struct DrawnSystem {
  Polynomials polynomials;   ///< of this experiment's plant, and of the noise
  double time_constant = 0;  ///< first_order: tau [s]; else 0
  int component = -1;  ///< of the mixture that xi came from, from 0; -1 = no error model; that
                       ///< of exp_mode comes last
  Eigen::VectorXd xi;  ///< free parameters of the relative error
  EffectDraws effects;
};

/// The id of experiment r (from 0), e.g. "exp_000007".
std::string experimentId(int r);

/// The system of experiment r (from 0). It depends on the truth, the seed and r alone; under
/// plant_aging also on where among the truth's experiments r stands.
DrawnSystem drawSystem(const Truth& truth, std::uint64_t seed, int r);

/// Experiment r (from 0), which does not depend on how many there are. Experiments follow each
/// other in time, ten sample times apart, the first at 1 s. An output that is not measured is NaN
/// and marked so. Throws ConfigurationError when an effect makes the output diverge.
Experiment simulateExperiment(const Truth& truth, std::uint64_t seed, int r);

/// All experiments of a truth. Throws ConfigurationError when the truth is not valid.
std::vector<Experiment> simulate(const Truth& truth, std::uint64_t seed);

}  // namespace uncertainty_identification
