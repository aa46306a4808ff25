#include "simulation/actuator_effects.h"

#include <gtest/gtest.h>

#include "support/hidden.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;
using test::expectNear;
using test::vectorOf;

const VectorXd kInput = vectorOf({0, 1, 3, -0.25, -2, -1, 0.4, 0});

void expectActuated(const ActuatorEffects& effects, std::initializer_list<double> expected) {
  EffectsTruth truth;
  truth.actuator = effects;
  truth.validate();
  expectNear(actuated(effects, kInput), vectorOf(expected));
}

TEST(ActuatorEffects, NoneLeavesTheInput) { expectActuated({}, {0, 1, 3, -0.25, -2, -1, 0.4, 0}); }

TEST(ActuatorEffects, Offset) {
  ActuatorEffects effects;
  effects.offset = {0.5};
  expectActuated(effects, {0.5, 1.5, 3.5, 0.25, -1.5, -0.5, 0.9, 0.5});
}

TEST(ActuatorEffects, DelayIsLinearBetweenSamples) {
  ActuatorEffects effects;
  effects.delay = {1.25};  // 3/4 u(t - 1) + 1/4 u(t - 2)
  expectActuated(effects, {0, 0, 0.75, 2.5, 0.5625, -1.5625, -1.25, 0.05});
  effects.delay = {100};
  expectActuated(effects, {0, 0, 0, 0, 0, 0, 0, 0});
  effects.delay = {0};
  expectActuated(effects, {0, 1, 3, -0.25, -2, -1, 0.4, 0});
}

TEST(ActuatorEffects, Quantisation) {
  ActuatorEffects effects;
  effects.quantisation = {0.7};
  expectActuated(effects, {0, 0.7, 2.8, 0, -2.1, -0.7, 0.7, 0});
}

TEST(ActuatorEffects, DeadZoneMayDifferBySign) {
  ActuatorEffects effects;
  effects.deadzone = {0.5, {}};
  expectActuated(effects, {0, 0.5, 2.5, 0, -1.5, -0.5, 0, 0});
  effects.deadzone = {0.5, 1.5};
  expectActuated(effects, {0, 0.5, 2.5, 0, -0.5, 0, 0, 0});
}

TEST(ActuatorEffects, BacklashRestsWhileTheInputTurns) {
  ActuatorEffects effects;
  effects.backlash = {1};
  expectActuated(effects, {0, 0.5, 2.5, 0.25, -1.5, -1.5, -0.1, -0.1});
}

TEST(ActuatorEffects, RateLimit) {
  ActuatorEffects effects;
  effects.ratelimit = {0.8};
  expectActuated(effects, {0, 0.8, 1.6, 0.8, 0, -0.8, 0, 0});
}

TEST(ActuatorEffects, Saturation) {
  ActuatorEffects effects;
  effects.saturation = {0.9};
  expectActuated(effects, {0, 0.9, 0.9, -0.25, -0.9, -0.9, 0.4, 0});
}

TEST(ActuatorEffects, Hammerstein) {
  ActuatorEffects effects;
  effects.hammerstein = {0.5, -0.1};
  expectActuated(effects,
                 {0, 1.4, 4.8, -0.25 + 0.03125 + 0.0015625, 0.8, -0.4, 0.4 + 0.08 - 0.0064, 0});
}

TEST(ActuatorEffects, LossBeginsBetweenSamples) {
  ActuatorEffects effects;
  effects.loss = {0.5, 4.25};  // three quarters of the loss at sample 4
  expectActuated(effects, {0, 1, 3, -0.25, -2 * (1 - 0.5 * 0.75), -0.5, 0.2, 0});
}

TEST(ActuatorEffects, SeveralActInOrder) {
  ActuatorEffects effects;
  effects.saturation = {1};
  effects.deadzone = {0.5, {}};
  effects.delay = {1};
  expectActuated(effects, {0, 0, 0.5, 1, 0, -1, -0.5, 0});
}

TEST(ActuatorEffects, ReachThePlant) {
  Truth truth = test::unitDelay();
  truth.effects.actuator.deadzone = {0.7, {}};
  const Experiment experiment = simulateExperiment(truth, 1, 0);
  expectNear(test::reached(experiment), actuated(truth.effects.actuator, experiment.u).head(199));
}

}  // namespace
}  // namespace uncertainty_identification
