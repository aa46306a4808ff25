#pragma once

#include <optional>
#include <vector>

#include "support/hidden_effects/hidden_effect.h"
#include "uncertainty_identification/estimation/estimate.h"

/// The gain that could be reached: that of the model with the hidden effect and its true
/// parameters.
namespace uncertainty_identification::suite {

/// Log density [nats] per experiment of `fresh` by which the extended model with the hidden effect
/// beats the estimate `before`, which lacks it. The better of two parameter values counts: the true
/// ones, and those of a fit to `training` that starts from them. There is no value when
///  - several effects are hidden;
///  - the effect is not a stage of the extended model: its samples are masked, or it belongs to the
///    mixture or to the way in which the experiments were made;
///  - the plant is given by a time constant, which is not a parameter of the model.
std::optional<double> trueGain(const test::HiddenEffect& hidden, const Estimate& before,
                               const std::vector<Experiment>& training,
                               const std::vector<Experiment>& fresh);

}  // namespace uncertainty_identification::suite
