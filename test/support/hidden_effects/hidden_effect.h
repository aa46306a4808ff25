#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "support/hidden_effects/random_truth.h"
#include "uncertainty_identification/data/experiment.h"

/// Effects hidden at random in random systems, for who looks for them to be tried on.
namespace uncertainty_identification::test {

/// Names of the catalogue: the 35 effects and plant_parameter_spread.
const std::vector<std::string>& catalogueEffects();

/// Names of effects that are in no catalogue.
const std::vector<std::string>& unnamedEffects();

/// A random system that hides effects.
struct HiddenEffect {
  std::vector<std::string> names;  ///< what is hidden; empty: nothing
  Truth truth;                     ///< with the effects
  Configuration declared;          ///< what the explaining side is told
  std::uint64_t seed = 0;          ///< of the experiments: simulate(truth, seed)
  std::vector<double> strengths;   ///< of each effect alone, as reached
  int redraws = 0;                 ///< systems drawn before one in which the strengths can be met
};

/// How a hidden effect is drawn.
struct HiddenEffectOptions {
  RandomTruthOptions base;
  double strength = 0.05;  ///< of each effect; above 0
  int held_out = 12;       ///< experiments beyond base.experiments, spread evenly among them

  void validate() const;
};

/// Draws a random system and hides the named effects in it, each with random parameters of a size
/// such that alone it has the strength, by bisection, within 2 % of it:
///  - mean (y with effect - y without)^2 / Var(noise-free y without), noise and xi being the same;
///  - noise_*: nats per sample that a likelihood gains which knows the effect (Kullback-Leibler),
///    over the best Gaussian noise of the declared orders; the zeros C stay where they are;
///  - exp_feedback, which no share of the output makes visible: the gain K at which the correlation
///    of an innovation with the next input, K sigma_w/sigma_u, is 0.06 to 0.1, whatever `strength`.
///
/// A system in which that size is not reached within the effect's range is replaced by another
/// draw. So are two-level inputs for effects that are static in the input (act_saturation,
/// act_deadzone, act_backlash, act_hammerstein, act_quantisation, noise_hetero): with two levels
/// they only scale. Nothing else is: an effect of that strength that the data cannot show stays.
///
/// The same names, options and seed give the same system and experiments. Throws ConfigurationError
/// for an unknown name or when no system is found.
HiddenEffect randomHiddenEffect(const std::vector<std::string>& names,
                                const HiddenEffectOptions& options, std::uint64_t seed);

/// The experiments of a hidden effect, as they are handed out.
struct HiddenEffectData {
  std::vector<Experiment> training;  ///< base.experiments of them
  std::vector<Experiment> held_out;  ///< in time between those
};

HiddenEffectData simulateHidden(const HiddenEffect& hidden, const HiddenEffectOptions& options);

/// Fresh experiments on the same system within the same span of time, which is where aging counts.
std::vector<Experiment> simulateFresh(const HiddenEffect& hidden, int count);

}  // namespace uncertainty_identification::test
