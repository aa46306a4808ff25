#include "support/hidden_effects/effect_size.h"

#include <algorithm>
#include <cmath>

#include "configuration/require.h"
#include "support/hidden_effects/draw.h"

namespace uncertainty_identification::test {

SetSize drawActuatorEffect(const std::string& name, const SignalScale& scale,
                           std::mt19937_64& random, const Truth& truth) {
  const double u = scale.u, u_max = scale.u_max, u_step = scale.u_step;
  const double direction = sign(random), angle = uniform(-3, 3, random);
  const double start = uniform(0.2, 0.8, random) * truth.samples.front();
  if (name == "act_offset")
    return [=](double s, Truth* t) { t->effects.actuator.offset = {2 * u * direction * s}; };
  if (name == "act_delay") return [=](double s, Truth* t) { t->effects.actuator.delay = {6 * s}; };
  if (name == "act_quantisation")
    return [=](double s, Truth* t) { t->effects.actuator.quantisation = {4 * u * s}; };
  if (name == "act_deadzone")
    return [=](double s, Truth* t) { t->effects.actuator.deadzone = {2 * u * s, {}}; };
  if (name == "act_backlash")
    return [=](double s, Truth* t) { t->effects.actuator.backlash = {4 * u * s}; };
  if (name == "act_ratelimit")
    return [=](double s, Truth* t) { t->effects.actuator.ratelimit = {u_step * remaining(s)}; };
  if (name == "act_saturation")
    return [=](double s, Truth* t) { t->effects.actuator.saturation = {u_max * remaining(s)}; };
  if (name == "act_hammerstein")
    return [=](double s, Truth* t) {
      t->effects.actuator.hammerstein = {s * std::cos(angle) / u,
                                         s * std::sin(angle) / (3 * u * u)};
    };
  if (name == "act_loss") return [=](double s, Truth* t) { t->effects.actuator.loss = {s, start}; };
  return {};
}

namespace {

/// Chooses the parameter that is spread: a coefficient of Go, or the time constant of a plant of
/// first order, which is then described by its time constant.
ParameterSpreadTruth drawSpread(std::mt19937_64& random, Truth* truth) {
  PlantTruth& plant = truth->plant;
  if (plant.a.size() == 1 && plant.a(0) < 0) {
    plant.gain = plant.b(0) / (1 + plant.a(0));
    plant.time_constant = -truth->sample_time / std::log(-plant.a(0));
    plant.structure = PlantStructure::first_order;
    return {"time_constant", 0};
  }
  const auto b = static_cast<int>(plant.b.size()), a = static_cast<int>(plant.a.size());
  const int which = whole(1, b + a, random);
  return {which <= b ? "b" + std::to_string(which) : "a" + std::to_string(which - b), 0};
}

}  // namespace

SetSize drawPlantEffect(const std::string& name, const SignalScale& scale, std::mt19937_64& random,
                        Truth* truth) {
  const double u = scale.u, y = scale.y, direction = sign(random);
  const double radius = uniform(0.9, 0.98, random), frequency = uniform(0.3, 2.5, random),
               angle = uniform(-3, 3, random), smoothing = uniform(0.05, 0.3, random);
  if (name == "plant_pole") return [=](double s, Truth* t) { t->effects.plant.pole = {0.97 * s}; };
  if (name == "plant_resonance")
    return [=](double s, Truth* t) {
      const double g = 3 * s * (1 - radius) * y / u;
      t->effects.plant.resonance = {radius, frequency, g * std::cos(angle), g * std::sin(angle)};
    };
  if (name == "plant_cubic")
    return [=](double s, Truth* t) { t->effects.plant.cubic = {s * u / (y * y * y)}; };
  if (name == "plant_coulomb")
    return [=](double s,
               Truth* t) {  // with less smoothing the output would oscillate from sample to sample
      const double friction = 2 * u * s, least = 1.5 * std::abs(t->plant.b(0)) * friction;
      t->effects.plant.coulomb = {friction, std::max(smoothing * y, least)};
    };
  if (name == "plant_drift")
    return [=](double s, Truth* t) { t->effects.plant.drift = {2 * direction * s}; };
  if (name == "plant_temp")
    return [=](double s, Truth* t) { t->effects.plant.temp = {direction * s, 20}; };
  if (name == "plant_init")
    return [=](double s, Truth* t) { t->effects.plant.init = {20 * y * s}; };
  if (name == "plant_aging") {
    const Eigen::VectorXd shift = directionOf(truth->error_model.mixture.dimension(), random);
    return [=](double s, Truth* t) { t->effects.plant.aging = {4 * s * shift}; };
  }
  if (name == "plant_parameter_spread") {
    const ParameterSpreadTruth spread = drawSpread(random, truth);
    return [=](double s, Truth* t) {
      t->effects.plant.parameter_spread = {spread.parameter, 0.5 * s};
    };
  }
  return {};
}

SetSize drawEffect(const std::string& name, const SignalScale& scale, std::mt19937_64& random,
                   Truth* truth) {
  for (const SetSize& set :
       {drawActuatorEffect(name, scale, random, *truth), drawSensorEffect(name, scale, random),
        drawNoiseEffect(name, scale, random, *truth),
        drawExperimentEffect(name, scale, random, *truth), drawUnnamedEffect(name, scale, random),
        drawPlantEffect(name, scale, random, truth)}) {
    if (set) return set;
  }
  throw ConfigurationError("effect: found '" + name +
                           "'; allowed: a name of config/truth_reference.yaml");
}

}  // namespace uncertainty_identification::test
