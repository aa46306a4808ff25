#include "uncertainty_identification/effects/catalogue.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "configuration/edit_distance.h"
#include "effects/built_in_effects.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

struct BuiltIn {
  const char* name;
  MadeEffects (*make)(const DataSummary&);
};

/// The catalogue in physical order: effects of one stage act in this order.
constexpr BuiltIn kCatalogue[] = {
    // Stage::measurement
    {"sens_lag", sensorLag},
    {"noise_colour", noiseColour},
    // Stage::actuator
    {"act_offset", actuatorOffset},
    {"act_delay", actuatorDelay},
    {"act_quantisation", actuatorQuantisation},
    {"act_deadzone", actuatorDeadZone},
    {"act_backlash", actuatorBacklash},
    {"act_ratelimit", actuatorRateLimit},
    {"act_saturation", actuatorSaturation},
    {"act_hammerstein", actuatorCurve},
    {"act_loss", actuatorLoss},
    {"plant_drift", plantDrift},
    {"plant_temp", plantTemperature},
    // Stage::loop
    {"plant_cubic", plantCubicStiffness},
    {"plant_coulomb", plantCoulombFriction},
    // Stage::plant
    {"plant_resonance", plantResonance},
    {"plant_pole", plantPole},
    // Stage::output
    {"plant_aging", plantAging},
    {"plant_init", plantInitialState},
    {"plant_parameter_spread", plantParameterSpread},
    {"plant_parameter_spread", plantTimeConstantSpread},
    {"exp_input2", secondInput},
    {"exp_jitter", samplingJitter},
    {"exp_clock", clockOffset},
    {"sens_wiener", sensorCurve},
    {"sens_clip", sensorClipping},
    {"sens_bias", sensorBias},
    {"sens_drift", sensorDrift},
    {"sens_hum", sensorHum},
    // Stage::noise
    {"noise_hetero", noiseLevel},
    {"noise_step", noiseStep},
    // Stage::data, where order does not matter
    {"", effectsOutsideTheChain},
};

struct Entry {
  std::string name;  ///< empty for effects that a user registered
  EffectFactory make;
};

/// An effect that a user registered. Its place is found when the catalogue is made, not while
/// static objects are constructed, where nobody could catch an exception.
struct Registered {
  enum class Place { last, before, after } place;
  std::string neighbour;
  EffectFactory factory;
};

std::vector<Registered>& registeredEffects() {
  static std::vector<Registered> all;
  return all;
}

void insert(const Registered& effect, std::vector<Entry>* all) {
  if (effect.place == Registered::Place::last) {
    all->push_back({"", effect.factory});
    return;
  }
  const auto is_neighbour = [&](const Entry& entry) { return entry.name == effect.neighbour; };
  const auto first = std::find_if(all->begin(), all->end(), is_neighbour);
  if (first == all->end() || effect.neighbour.empty())
    throw ConfigurationError("effects: one of your own is to act before or after '" +
                             effect.neighbour +
                             "', which is no effect of the chain; docs/explanation.md lists them");
  auto place = first;
  if (effect.place == Registered::Place::after) {
    place = std::find_if_not(first, all->end(), is_neighbour);
    // Effects registered earlier at the same place keep their order.
    while (place != all->end() && place->name.empty()) ++place;
  }
  all->insert(place, {"", effect.factory});
}

}  // namespace

EffectRegistration::EffectRegistration(EffectFactory factory) {
  registeredEffects().push_back({Registered::Place::last, "", std::move(factory)});
}

EffectRegistration::EffectRegistration(Before place, EffectFactory factory) {
  registeredEffects().push_back(
      {Registered::Place::before, std::move(place.effect), std::move(factory)});
}

EffectRegistration::EffectRegistration(After place, EffectFactory factory) {
  registeredEffects().push_back(
      {Registered::Place::after, std::move(place.effect), std::move(factory)});
}

Effects catalogue(const DataSummary& data) {
  std::vector<Entry> entries;
  for (const BuiltIn& effect : kCatalogue) entries.push_back({effect.name, effect.make});
  for (const Registered& effect : registeredEffects()) insert(effect, &entries);
  Effects all;
  int position = 0;
  for (const Entry& entry : entries) {
    for (auto& effect : entry.make(data)) {
      effect->setPosition(position);
      all.push_back(std::move(effect));
    }
    ++position;
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& left, const auto& right) {
    return left->stage() < right->stage();
  });
  return all;
}

std::vector<std::string> registeredNames(const DataSummary& data) {
  std::vector<std::string> names;
  for (const Registered& registered : registeredEffects())
    for (const auto& effect : registered.factory(data)) names.push_back(effect->name());
  return names;
}

std::shared_ptr<const Effect> findEffect(const Effects& catalogue, const std::string& name,
                                         const std::string& variant) {
  const Effect* nearest = nullptr;
  for (const auto& effect : catalogue) {
    if (effect->name() == name && effect->description().variant == variant) return effect;
    if (nearest == nullptr ||
        editDistance(name, effect->name()) < editDistance(name, nearest->name()))
      nearest = effect.get();
  }
  throw ConfigurationError("effects: found '" + name + (variant.empty() ? "" : "', variant '") +
                           variant + "', which does not exist or does not fit these data" +
                           (nearest != nullptr ? "; the nearest is " + nearest->label() : ""));
}

std::shared_ptr<const Effect> findEffect(const Effects& catalogue, Trait trait) {
  const auto found = std::find_if(catalogue.begin(), catalogue.end(),
                                  [&](const auto& effect) { return effect->has(trait); });
  if (found == catalogue.end()) throw std::logic_error("effects: none has the trait asked for");
  return *found;
}

bool hasTrait(const std::string& name, Trait trait) {
  static const MadeEffects all = [] {
    MadeEffects made;
    DataSummary data;
    data.plant_parameters.emplace_back("any");
    for (const BuiltIn& effect : kCatalogue)
      for (auto& each : effect.make(data)) made.push_back(std::move(each));
    return made;
  }();
  return std::any_of(all.begin(), all.end(), [&](const auto& effect) {
    return effect->name() == name && effect->has(trait);
  });
}

std::string nearestEffect(const std::string& name, DataSummary data) {
  data.experiments = std::max(data.experiments, 100);
  data.regressors = std::max(data.regressors, 1);
  data.covariates.emplace("any", 0);
  data.plant_parameters.emplace_back("any");
  data.stamps = true;
  std::string nearest;
  for (const auto& effect : catalogue(data)) {
    if (nearest.empty() || editDistance(name, effect->name()) < editDistance(name, nearest))
      nearest = effect->name();
  }
  return nearest;
}

}  // namespace uncertainty_identification
