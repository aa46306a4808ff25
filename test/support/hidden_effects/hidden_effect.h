#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "support/hidden_effects/random_truth.h"
#include "uncertainty_identification/data/experiment.h"

/// Random systems with random effects, on which explain() is tested: it must find the effects.
namespace uncertainty_identification::test {

/// Names of the simulated effects that are in the catalogue of explain().
std::vector<std::string> catalogueEffects();

/// Names of the simulated effects that are not in the catalogue.
std::vector<std::string> unnamedEffects();

/// A random system with effects that the explaining side does not know.
struct HiddenEffect {
  std::vector<std::string> names;  ///< of the effects; empty when the system has none
  Truth truth;                     ///< the system, with the effects
  Configuration declared;          ///< the configuration that explain() is given
  std::uint64_t seed = 0;          ///< the experiments are simulate(truth, seed)
  std::vector<double> strengths;   ///< that each effect has on its own
  int redraws = 0;                 ///< systems drawn and rejected before this one
};

/// How systems and their effects are drawn.
struct HiddenEffectOptions {
  RandomTruthOptions base;
  double strength = 0.05;  ///< of each effect; above 0
  int held_out = 12;       ///< experiments besides base.experiments, spread evenly among them

  void validate() const;
};

/// Draws a random system and gives it the named effects. The parameters of each effect are random;
/// their size is found by bisection such that the effect on its own has the wanted strength within
/// 2 %. The strength is
///  - in general mean (y with effect - y without)^2 / Var(noise-free y without), where both outputs
///    have the same noise and the same xi;
///  - for noise_*, the log-likelihood [nats per sample] that a model with the effect gains over the
///    best Gaussian noise model of the declared orders with the same zeros C (Kullback-Leibler
///    divergence);
///  - for exp_feedback, the correlation of an innovation with the next input, K sigma_w/sigma_u.
///    It is drawn from 0.06 to 0.1 whatever `strength` is, since even a strong feedback changes the
///    output little.
///
/// Another system is drawn
///  - when the strength cannot be reached within the effect's range;
///  - when the input has two levels and the effect is static in the input (act_saturation,
///    act_deadzone, act_backlash, act_hammerstein, act_quantisation, noise_hetero), because it only
///    changes the gain then;
///  - when all effects together make the output diverge.
/// A system is kept even if its data cannot show the effect.
///
/// The same names, options and seed give the same system and experiments. Throws ConfigurationError
/// for an unknown name and when no suitable system is found.
HiddenEffect randomHiddenEffect(const std::vector<std::string>& names,
                                const HiddenEffectOptions& options, std::uint64_t seed);

/// The experiments of a system, divided into two parts.
struct HiddenEffectData {
  std::vector<Experiment> training;  ///< base.experiments of them
  std::vector<Experiment> held_out;  ///< made between those
};

/// Simulates the experiments of a system.
HiddenEffectData simulateHidden(const HiddenEffect& hidden, const HiddenEffectOptions& options);

/// Simulates `count` further experiments on the same system with other random numbers. They are
/// spread over the time of the first ones, because plant_aging changes the system over time.
std::vector<Experiment> simulateFresh(const HiddenEffect& hidden, int count);

}  // namespace uncertainty_identification::test
