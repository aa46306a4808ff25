#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "support/dense_likelihood.h"
#include "uncertainty_identification/data/experiment.h"

/// Random stable systems, and experiments simulated from them, for property tests.
namespace uncertainty_identification::test {

/// What is drawn.
struct RandomSystemOptions {
  int nb = 1, na = 1, nc = 1, nd = 1;
  int delay = 1;  ///< [samples]
  int taps = 2;   ///< basis filters, 0 = no error model
  double laguerre_pole =
      0;  ///< 0: FIR taps q^0..q^-(taps-1); otherwise Laguerre filters from q^0 on
  bool zero_static_gain = true;  ///< T with GDelta(1) = 0 (n = taps - 1); otherwise T = I
  int components = 2;            ///< kappa
  double pole_radius = 0.9;      ///< roots of A, C and D lie inside
  double noise_variance = 0.1;   ///< sigma^2
  double output_offset = 0;      ///< added to every y

  int experiments = 20;                     ///< M
  int min_samples = 50, max_samples = 100;  ///< N_r is drawn between them, both included
  double missing = 0;          ///< share of the outputs not measured, in runs of 1 to 5 samples
  double input_deviation = 3;  ///< standard deviation of the white input
  int noise_run_up =
      0;  ///< samples the noise runs before sample 0: 0 = from rest; many = stationary
  int input_run_up = 0;  ///< samples the input runs before sample 0: 0 = Go at rest
};

/// A system and what was measured of it.
struct RandomSystem {
  dense::Model truth;
  std::vector<Experiment> experiments;  ///< missing outputs hold NaN and valid = 0
  std::vector<Eigen::VectorXd> errors;  ///< xi_r (n) of each experiment
  std::vector<int> components;          ///< the component each was drawn from
};

/// Full coefficients [1, p_1..p_order] of a polynomial whose roots, real or in complex pairs, lie
/// within `radius`.
Eigen::VectorXd randomPolynomial(int order, double radius, std::uint64_t seed);

/// Draws a system and its experiments. The same options and seed give the same system.
RandomSystem randomSystem(const RandomSystemOptions& options, std::uint64_t seed);

/// Simulates experiments of a given system; sizes, signals and shares are those of `options`.
RandomSystem simulateSystem(const dense::Model& truth, const RandomSystemOptions& options,
                            std::uint64_t seed);

}  // namespace uncertainty_identification::test
