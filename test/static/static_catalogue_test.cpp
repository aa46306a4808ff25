// Linked with a static archive of the core, where the linker keeps only what something refers to:
// the whole catalogue must be there, and effects that a program registers must act where they say.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "simulation/effects_truth.h"
#include "uncertainty_identification/effects/catalogue.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

EffectFactory named(const std::string& name, Stage stage) {
  return [name, stage](const DataSummary&) -> MadeEffects {
    EffectDescription description;
    description.name = name;
    description.stage = stage;
    return {std::make_shared<Effect>(description)};
  };
}

const EffectRegistration kFirst(After{"act_deadzone"}, named("act_first", Stage::actuator));
const EffectRegistration kSecond(After{"act_deadzone"}, named("act_second", Stage::actuator));
const EffectRegistration kFront(Before{"act_offset"}, named("act_front", Stage::actuator));
const EffectRegistration kLast(named("act_last", Stage::actuator));
const EffectRegistration kSpread(After{"plant_parameter_spread"},
                                 named("plant_other_spread", Stage::output));

/// Names in order, each once, for data with a covariate, time stamps and a first-order plant.
std::vector<std::string> names() {
  DataSummary data;
  data.experiments = 10;
  data.samples = 100;
  data.regressors = 1;
  data.covariates = {{"temperature", 0}};
  data.stamps = true;
  data.plant_parameters = {"b1", "a1"};
  std::vector<std::string> all;
  for (const auto& effect : catalogue(data)) all.push_back(effect->name());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

/// The effects from `first` on.
std::vector<std::string> from(const std::string& first, std::ptrdiff_t count) {
  const std::vector<std::string> all = names();
  const auto begin = std::find(all.begin(), all.end(), first);
  return {begin, begin + std::min<std::ptrdiff_t>(count, all.end() - begin)};
}

using Names = std::vector<std::string>;

TEST(StaticCatalogue, HoldsTheWholeCatalogueAndWhatTheProgramRegisters) {
  const Names found = names();
  std::set<std::string> expected;  // every effect that `simulate` can hide has its counterpart
  EffectsTruth().forEach([&expected](const std::string& name, const auto& /*effect*/) {
    if (name.rfind("unk_", 0) != 0) expected.insert(name);
  });
  expected.insert({"act_first", "act_second", "act_front", "act_last", "plant_other_spread"});
  EXPECT_EQ(std::set<std::string>(found.begin(), found.end()), expected);
}

TEST(StaticCatalogue, RegisteredEffectsActWhereTheySay) {
  EXPECT_EQ(from("act_deadzone", 4),
            (Names{"act_deadzone", "act_first", "act_second", "act_backlash"}));
  EXPECT_EQ(from("act_front", 2), (Names{"act_front", "act_offset"}));
  EXPECT_EQ(from("plant_temp", 3), (Names{"plant_temp", "act_last", "plant_cubic"}));
  EXPECT_EQ(from("plant_parameter_spread", 3),
            (Names{"plant_parameter_spread", "plant_other_spread", "exp_input2"}));
}

/// The last test, because the registration stays.
TEST(StaticCatalogue, RefusesAPlaceBesideAnUnknownEffect) {
  const EffectRegistration wrong(Before{"act_dedzone"}, named("act_lost", Stage::actuator));
  try {
    names();
    FAIL() << "accepted";
  } catch (const ConfigurationError& error) {
    EXPECT_NE(std::string(error.what()).find("act_dedzone"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace uncertainty_identification
