#include "uncertainty_identification/effects/catalogue.h"

#include <algorithm>
#include <map>

#include "configuration/edit_distance.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

std::multimap<int, EffectFactory>& factories() {
  static std::multimap<int, EffectFactory> all;
  return all;
}

}  // namespace

EffectRegistration::EffectRegistration(int position, EffectFactory factory) {
  factories().emplace(position, std::move(factory));
}

Effects catalogue(const DataSummary& data) {
  Effects all;
  for (const auto& [position, factory] : factories()) {
    for (auto& effect : factory(data)) {
      effect->setPosition(position);
      all.push_back(std::move(effect));
    }
  }
  std::stable_sort(all.begin(), all.end(), [](const auto& left, const auto& right) {
    return left->stage() < right->stage();
  });
  return all;
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
