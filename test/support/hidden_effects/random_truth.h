#pragma once

#include <cstdint>
#include <random>

#include "simulation/truth.h"
#include "uncertainty_identification/configuration.h"

/// Random systems, so that methods are tested on many systems that nobody has chosen for them.
namespace uncertainty_identification::test {

/// How many experiments are made on a random system.
struct RandomTruthOptions {
  int experiments = 30;  ///< M
  int samples = 300;     ///< N

  void validate() const;
};

/// Draws a system without effects:
///  - sample time 1 s;
///  - Go of order 1 to 3 with delay 1, poles up to 0.95 and zeros that are not near them, static
///    gain 0.5 to 3;
///  - output error or Box-Jenkins noise with one pole and at most one zero, stationary from the
///    start, at a signal-to-noise ratio of 20 to 30 dB;
///  - an FIR error model with one or two free parameters and no static gain;
///  - a mixture of one to three components, whose means are at least six standard deviations apart;
///  - white noise, PRBS, steps or a multisine as input;
///  - in half of the systems an amplitude of the input that differs between experiments;
///  - the covariates `temp` and `d`, which have no effect.
Truth randomTruth(const RandomTruthOptions& options, std::mt19937_64& random);

/// The configuration with which somebody would identify the system who knows everything but its
/// effects: the true orders, taps, number of components (without that of exp_mode) and constraint,
/// a plant that starts at rest, no offsets, stationary noise. Bounds are not computed.
Configuration declaredSimulation(const Truth& truth);

/// How large the signals of a system are, over all experiments and without noise.
struct SignalScale {
  double u = 0, y = 0;          ///< root mean square
  double u_max = 0, y_max = 0;  ///< largest magnitude
  double u_step = 0;            ///< largest change of u from sample to sample
};

/// Simulates the truth without noise and measures its signals.
SignalScale signalScale(Truth truth, std::uint64_t seed);

}  // namespace uncertainty_identification::test
