#pragma once

#include <functional>
#include <string>

#include "uncertainty_identification/effects/effect.h"

namespace uncertainty_identification {

/// Makes the forms of one effect that fit a data set; none where the data lack what it needs.
using MadeEffects = std::vector<std::shared_ptr<Effect>>;
using EffectFactory = std::function<MadeEffects(const DataSummary&)>;

/// Where an effect of your own acts among the catalogue's effects of the same stage, by the name of
/// the effect that it directly precedes or follows.
struct Before {
  std::string effect;
};
struct After {
  std::string effect;
};

/// Adds an effect of your own to the catalogue: one static object in the effect's source file.
/// Without a place the effect acts after all others of its stage. The file must be part of the
/// program or of a shared library: of a static library the linker drops files that nothing refers
/// to, and the effect would be missing without a message.
struct EffectRegistration {
  explicit EffectRegistration(EffectFactory factory);
  EffectRegistration(Before place, EffectFactory factory);
  EffectRegistration(After place, EffectFactory factory);
};

/// All effects for a data set, in physical order. Throws ConfigurationError where an effect was
/// registered before or after one that does not exist.
Effects catalogue(const DataSummary& data);

/// The names of the effects that users have registered, for a data set.
std::vector<std::string> registeredNames(const DataSummary& data);

/// The effect of this name and variant. Throws ConfigurationError, which names the nearest effect,
/// where there is none.
std::shared_ptr<const Effect> findEffect(const Effects& catalogue, const std::string& name,
                                         const std::string& variant);

/// The first effect with this trait, which must be there.
std::shared_ptr<const Effect> findEffect(const Effects& catalogue, Trait trait);

/// Whether a built-in effect of this name has this trait. Effects that are made only for certain
/// data, with covariates, time stamps or several experiments, are not considered.
bool hasTrait(const std::string& name, Trait trait);

/// The effect whose name is nearest to this one. Effects that need covariates, time stamps or more
/// experiments are considered even where these data have none.
std::string nearestEffect(const std::string& name, DataSummary data);

}  // namespace uncertainty_identification
