#pragma once

#include <algorithm>
#include <functional>
#include <random>
#include <string>

#include "support/hidden_effects/random_truth.h"

/// Draws the parameters of an effect at random, except for its size, which randomHiddenEffect()
/// then adjusts until the effect has the wanted strength.
namespace uncertainty_identification::test {

/// Gives a truth the effect in a size between 0, hardly any effect, and 1, the largest that makes
/// sense.
using SetSize = std::function<void(double size, Truth* truth)>;

/// For parameters that are small when the effect is large, such as a limit.
inline double remaining(double size) { return std::max(1 - size, 1e-3); }

/// Draws the parameters of the named effect other than its size. `scale` tells how large the
/// signals of the truth are. For plant_parameter_spread the truth's plant may be given another
/// structure. Throws ConfigurationError for an unknown name.
SetSize drawEffect(const std::string& name, const SignalScale& scale, std::mt19937_64& random,
                   Truth* truth);

/// The parts of drawEffect(). Each returns an empty function when it does not know the name.
/// drawEffect() calls all of them in a fixed order, which decides the random numbers of each
/// effect.
SetSize drawActuatorEffect(const std::string& name, const SignalScale& scale,
                           std::mt19937_64& random, const Truth& truth);
SetSize drawPlantEffect(const std::string& name, const SignalScale& scale, std::mt19937_64& random,
                        Truth* truth);
SetSize drawSensorEffect(const std::string& name, const SignalScale& scale,
                         std::mt19937_64& random);
SetSize drawNoiseEffect(const std::string& name, const SignalScale& scale, std::mt19937_64& random,
                        const Truth& truth);
SetSize drawExperimentEffect(const std::string& name, const SignalScale& scale,
                             std::mt19937_64& random, const Truth& truth);
SetSize drawUnnamedEffect(const std::string& name, const SignalScale& scale,
                          std::mt19937_64& random);

}  // namespace uncertainty_identification::test
