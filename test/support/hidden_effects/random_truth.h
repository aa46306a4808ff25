#pragma once

#include <cstdint>
#include <random>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/simulation/truth.h"

/// Systems drawn at random, to try methods on many that nobody has chosen.
namespace uncertainty_identification::test {

/// How much is measured of a drawn system.
struct RandomTruthOptions {
  int experiments = 30;  ///< M
  int samples = 300;     ///< N

  void validate() const;
};

/// A system without hidden effects: sample time 1 s; Go of order 1 to 3, delay 1, poles between 0.3
/// and 0.95 and zeros away from them, static gain 0.5 to 3; output error or Box-Jenkins (one pole,
/// at most one zero, stationary from the start); one or two free FIR error parameters without
/// static gain, in a mixture of one to three components at least six standard deviations apart;
/// white noise, PRBS, steps or a multisine as input, in half of the systems with an amplitude that
/// differs between experiments; a signal-to-noise ratio of 20 to 30 dB; covariates `temp` and `d`,
/// which do nothing.
Truth randomTruth(const RandomTruthOptions& options, std::mt19937_64& random);

/// The simulation that who made the experiments declares: orders, taps, components and constraint
/// of the truth, plant at rest at first, no offsets, stationary noise. It knows no effects,
/// exp_mode's component included. Bounds are not asked for.
Configuration declaredSimulation(const Truth& truth);

/// Standard deviations and largest values over all experiments of a truth, simulated without noise.
struct SignalScale {
  double u = 0, y = 0;          ///< root mean square
  double u_max = 0, y_max = 0;  ///< largest magnitude
  double u_step = 0;            ///< largest change of u from sample to sample
};

SignalScale signalScale(Truth truth, std::uint64_t seed);

}  // namespace uncertainty_identification::test
