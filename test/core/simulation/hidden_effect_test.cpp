#include "simulation/hidden_effect.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "io/truth_yaml.h"
#include "simulation/simulate.h"
#include "support/hidden_effects/hidden_effect.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification::test {
namespace {

using nlohmann::json;

HiddenEffectOptions small() {
  HiddenEffectOptions options;
  options.base = {6, 200};
  options.held_out = 3;
  return options;
}

std::vector<std::string> allNames() {
  std::vector<std::string> names = catalogueEffects();
  const std::vector<std::string> unnamed = unnamedEffects();
  names.insert(names.end(), unnamed.begin(), unnamed.end());
  return names;
}

/// What is hidden, by the keys of the truth.
std::vector<std::string> hiddenIn(const Truth& truth) {
  std::vector<std::string> names;
  const json effects = toJson(truth)["effects"];
  for (const auto& entry : effects.items()) names.push_back(entry.key());
  return names;
}

double variance(const std::vector<Experiment>& experiments) {
  double sum = 0, squares = 0, count = 0;
  for (const Experiment& experiment : experiments) {
    sum += experiment.y.sum();
    squares += experiment.y.squaredNorm();
    count += static_cast<double>(experiment.samples());
  }
  return squares / count - std::pow(sum / count, 2);
}

/// mean (y with - y without)^2 / Var(noise-free y without), from its definition.
double share(const HiddenEffect& hidden) {
  Truth without = hidden.truth;
  without.effects = EffectsTruth();
  const std::vector<Experiment> y = simulate(hidden.truth, hidden.seed),
                                plain = simulate(without, hidden.seed);
  without.noise.variance = 0;
  double squares = 0;
  for (std::size_t r = 0; r < y.size(); ++r) squares += (y[r].y - plain[r].y).squaredNorm();
  return squares / static_cast<double>(y.size()) / hidden.truth.samples[0] /
         variance(simulate(without, hidden.seed));
}

TEST(HiddenEffect, EveryEffectOfEveryCatalogueMeetsItsStrength) {
  for (const std::string& name : allNames()) {
    const HiddenEffect hidden = randomHiddenEffect({name}, small(), 7);
    EXPECT_EQ(hiddenIn(hidden.truth), std::vector<std::string>{name});
    ASSERT_EQ(hidden.strengths.size(), 1u);
    if (name == "exp_feedback") {
      EXPECT_GE(hidden.strengths[0], 0.0588);
      EXPECT_LE(hidden.strengths[0], 0.102);
    } else {
      EXPECT_NEAR(hidden.strengths[0], 0.05, 0.001) << name;
      if (name.rfind("noise_", 0) != 0) {
        EXPECT_NEAR(share(hidden), 0.05, 0.001) << name;
      }
    }
    EXPECT_LT(hidden.redraws, 100) << name;
  }
}

/// Mean log-likelihood ratio per sample of the noise that the truth has to the best white one.
TEST(HiddenEffect, StrengthOfTheNoiseIsAKullbackLeiblerGain) {
  HiddenEffectOptions options = small();
  options.strength = 0.2;
  HiddenEffect step = randomHiddenEffect({"noise_step"}, options, 3);
  step.truth.plant.b.setZero();
  step.truth.noise.c.resize(0);
  step.truth.noise.d.resize(0);
  step.truth.experiments = 500;
  const std::vector<Experiment> noise = simulate(step.truth, 1);
  const double pooled = variance(noise);
  double gain = 0;
  for (const Experiment& experiment : noise) {
    for (int k = 0; k < 200; ++k) {
      const auto& [ratio, start] = *step.truth.effects.noise.step;
      const double late = std::min(1.0, std::max(0.0, k - start + 1));
      const double own = step.truth.noise.variance * std::pow(ratio, 2 * late);
      const double square = experiment.y(k) * experiment.y(k);
      gain += 0.5 * (std::log(pooled / own) + square / pooled - square / own) / (500 * 200);
    }
  }
  // Standard error of the mean of so many ratios: below 0.005.
  EXPECT_NEAR(gain, 0.2, 0.02);
}

TEST(HiddenEffect, PairsEachMeetTheirStrengthAlone) {
  const HiddenEffect pair = randomHiddenEffect({"act_deadzone", "sens_hum"}, small(), 11);
  EXPECT_EQ(pair.strengths.size(), 2u);
  EXPECT_EQ(hiddenIn(pair.truth), (std::vector<std::string>{"act_deadzone", "sens_hum"}));
  HiddenEffect one = pair;
  one.truth.effects.sensor.hum.reset();
  EXPECT_NEAR(share(one), 0.05, 0.001);
  HiddenEffect other = pair;
  other.truth.effects.actuator.deadzone.reset();
  EXPECT_NEAR(share(other), 0.05, 0.001);
}

TEST(HiddenEffect, NothingHiddenIsARandomTruth) {
  const HiddenEffect clean = randomHiddenEffect({}, small(), 5);
  EXPECT_TRUE(hiddenIn(clean.truth).empty());
  EXPECT_EQ(clean.truth.experiments, 9);
}

TEST(HiddenEffect, OneSeedOneDataSet) {
  const HiddenEffect first = randomHiddenEffect({"plant_pole"}, small(), 2),
                     again = randomHiddenEffect({"plant_pole"}, small(), 2),
                     other = randomHiddenEffect({"plant_pole"}, small(), 3);
  EXPECT_EQ(toJson(first.truth), toJson(again.truth));
  EXPECT_EQ(first.seed, again.seed);
  EXPECT_NE(toJson(first.truth), toJson(other.truth));
}

TEST(HiddenEffect, DataAreSplitEvenlyInTime) {
  HiddenEffectOptions options = small();
  options.base.experiments = 30;
  options.held_out = 12;
  const HiddenEffect hidden = randomHiddenEffect({"plant_aging"}, options, 2);
  const HiddenEffectData data = simulateHidden(hidden, options);
  EXPECT_EQ(data.training.size(), 30u);
  ASSERT_EQ(data.held_out.size(), 12u);
  const std::vector<Experiment> all = simulate(hidden.truth, hidden.seed);
  EXPECT_EQ(data.training[0].y, all[0].y);
  EXPECT_EQ(data.held_out[0].y, all[3].y);
  EXPECT_EQ(data.held_out[11].y, all[41].y);
  const std::vector<Experiment> fresh = simulateFresh(hidden, 5);
  EXPECT_EQ(fresh.front().start_time, all.front().start_time);
  EXPECT_EQ(fresh.back().start_time, all.back().start_time);
  EXPECT_NE(fresh.front().y, all.front().y);
}

TEST(HiddenEffect, ExpModeIsNotDeclared) {
  const HiddenEffect hidden = randomHiddenEffect({"exp_mode"}, small(), 2);
  EXPECT_EQ(hidden.declared.error_model.components, hidden.truth.error_model.mixture.components());
}

TEST(HiddenEffect, UnknownNamesAndImpossibleStrengthsAreRefused) {
  EXPECT_THROW(randomHiddenEffect({"act_dleay"}, small(), 1), ConfigurationError);
  HiddenEffectOptions options = small();
  options.strength = 0;
  EXPECT_THROW(randomHiddenEffect({"act_delay"}, options, 1), ConfigurationError);
  options.strength = 1e9;
  EXPECT_THROW(randomHiddenEffect({"act_offset"}, options, 1), ConfigurationError);
}

}  // namespace
}  // namespace uncertainty_identification::test
