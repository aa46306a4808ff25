#pragma once

#include <algorithm>
#include <functional>
#include <random>
#include <string>

#include "support/hidden_effects/random_truth.h"

/// How random effects get their parameters: all but the size are drawn, the size is left open.
namespace uncertainty_identification::test {

/// Puts an effect of a size into a truth: just above 0 hardly any, 1 the largest that is sensible.
using SetSize = std::function<void(double size, Truth* truth)>;

/// Of a size that falls to nothing where the effect is largest, such as a limit.
inline double remaining(double size) { return std::max(1 - size, 1e-3); }

/// Draws the parameters of the named effect other than its size, for a truth with signals of this
/// scale; the truth is given what the effect needs. Throws ConfigurationError for an unknown name.
SetSize drawEffect(const std::string& name, const SignalScale& scale, std::mt19937_64& random,
                   Truth* truth);

/// Groups of drawEffect(); none for a name that is not theirs.
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
