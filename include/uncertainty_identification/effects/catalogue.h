#pragma once

#include <functional>
#include <string>

#include "uncertainty_identification/effects/effect.h"

namespace uncertainty_identification {

/// Makes the forms of one effect that fit a data set.
using MadeEffects = std::vector<std::shared_ptr<Effect>>;
using EffectFactory = std::function<MadeEffects(const DataSummary&)>;

/// Adds an effect to the catalogue when it is constructed: one static object in the effect's file.
/// `position`: effects of one stage act in rising order of it.
struct EffectRegistration {
  EffectRegistration(int position, EffectFactory factory);
};

/// All effects for a data set, in physical order.
Effects catalogue(const DataSummary& data);

/// The effect of this name and variant. Throws ConfigurationError naming the nearest where there is
/// none.
std::shared_ptr<const Effect> findEffect(const Effects& catalogue, const std::string& name,
                                         const std::string& variant);

/// The name nearest to this one among the effects that such data, or data that told more
/// (covariates, stamps), may have.
std::string nearestEffect(const std::string& name, DataSummary data);

}  // namespace uncertainty_identification
