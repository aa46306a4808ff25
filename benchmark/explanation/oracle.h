#pragma once

#include <optional>
#include <vector>

#include "support/hidden_effects/hidden_effect.h"
#include "uncertainty_identification/estimation/estimate.h"

/// What there is to be gained: the model with the effect that is hidden, by who knows it.
namespace uncertainty_identification::suite {

/// Log density [nats] per experiment of `fresh` that the true extended model gains over an estimate
/// without the effect: with the true parameters, or fitted to `training` from there on, whichever
/// predicts better. None where the effect is no part of a model's chain (its samples are masked, it
/// is a component of the mixture or the experiment's doing), stands beside another, or is stated in
/// other parameters than the model's (a time constant).
std::optional<double> trueGain(const test::HiddenEffect& hidden, const Estimate& before,
                               const std::vector<Experiment>& training,
                               const std::vector<Experiment>& fresh);

}  // namespace uncertainty_identification::suite
