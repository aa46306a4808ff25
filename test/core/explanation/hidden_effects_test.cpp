// Effects hidden in random systems, and found: a few of those that scripts/benchmark_explanation
// counts by the hundred. 5 % of the output's variance, the seed being the run's number, 1.
#include <gtest/gtest.h>

#include <algorithm>

#include "uncertainty_identification/explanation/explanation.h"
#include "uncertainty_identification/simulation/hidden_effect.h"

namespace uncertainty_identification {
namespace {

class HiddenEffects : public testing::TestWithParam<const char*> {};

TEST_P(HiddenEffects, AreNamed) {
  const std::string name = GetParam();
  HiddenEffectOptions options;
  options.base = {20, 200};
  const HiddenEffect hidden = randomHiddenEffect({name}, options, 1);
  const HiddenEffectData data = simulateHidden(hidden, options);
  const Explanation found = explain(hidden.declared, data.training, data.held_out);
  const auto names = [&](const Cause& cause) {
    return cause.name == name || std::count(cause.equivalent.begin(), cause.equivalent.end(), name);
  };
  EXPECT_TRUE(std::any_of(found.causes.begin(), found.causes.end(), names)) << found.message;
}

INSTANTIATE_TEST_SUITE_P(OfEachStage, HiddenEffects,
                         testing::Values("act_deadzone", "act_hammerstein", "plant_drift",
                                         "plant_cubic", "sens_bias", "sens_hum", "sens_outliers",
                                         "noise_colour"));

}  // namespace
}  // namespace uncertainty_identification
