#include "effect_size.h"

#include <algorithm>
#include <cmath>

#include "draw.h"
#include "uncertainty_identification/require.h"

namespace uncertainty_identification {
namespace {

/// Of a size that falls to nothing where the effect is largest, such as a limit.
double remaining(double size) { return std::max(1 - size, 1e-3); }

double samplesOf(const Truth& truth) { return truth.samples.front(); }

}  // namespace

SetSize drawActuatorEffect(const std::string& name, const SignalScale& scale,
                           std::mt19937_64& random, const Truth& truth) {
  const double u = scale.u, u_max = scale.u_max, u_step = scale.u_step;
  const double direction = sign(random), angle = uniform(-3, 3, random);
  const double start = uniform(0.2, 0.8, random) * samplesOf(truth);
  if (name == "act_offset")
    return [=](double s, Truth* t) { t->effects.actuator.offset = {2 * u * direction * s}; };
  if (name == "act_delay")
    return [=](double s, Truth* t) { t->effects.actuator.delay = {6 * s}; };
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
      t->effects.actuator.hammerstein = {s * std::cos(angle) / u, s * std::sin(angle) / (3 * u * u)};
    };
  if (name == "act_loss")
    return [=](double s, Truth* t) { t->effects.actuator.loss = {s, start}; };
  return {};
}

namespace {

/// A coefficient of Go, or of a first-order plant its time constant.
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
  if (name == "plant_pole")
    return [=](double s, Truth* t) { t->effects.plant.pole = {0.97 * s}; };
  if (name == "plant_resonance")
    return [=](double s, Truth* t) {
      const double g = 3 * s * (1 - radius) * y / u;
      t->effects.plant.resonance = {radius, frequency, g * std::cos(angle), g * std::sin(angle)};
    };
  if (name == "plant_cubic")
    return [=](double s, Truth* t) { t->effects.plant.cubic = {s * u / (y * y * y)}; };
  if (name == "plant_coulomb")
    return [=](double s, Truth* t) {  // less smoothing would chatter from sample to sample
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

SetSize drawSensorEffect(const std::string& name, const SignalScale& scale,
                         std::mt19937_64& random) {
  const double y = scale.y, y_max = scale.y_max, direction = sign(random);
  const bool coin = chance(0.5, random);
  const double angle = uniform(-3, 3, random), frequency = uniform(0.1, 2.8, random),
               probability = uniform(0.005, 0.03, random);
  if (name == "sens_wiener")
    return [=](double s, Truth* t) {
      t->effects.sensor.wiener = {s * std::cos(angle) / y, s * std::sin(angle) / (3 * y * y)};
    };
  if (name == "sens_bias")
    return [=](double s, Truth* t) { t->effects.sensor.bias = {2 * y * direction * s, coin, 2 * y * s}; };
  if (name == "sens_drift")
    return [=](double s, Truth* t) { t->effects.sensor.drift = {4 * y * direction * s, coin, 4 * y * s}; };
  if (name == "sens_hum")
    return [=](double s, Truth* t) { t->effects.sensor.hum = {2 * y * s, frequency, angle, coin}; };
  if (name == "sens_lag")
    return [=](double s, Truth* t) { t->effects.sensor.lag = {0.97 * s}; };
  if (name == "sens_outliers")
    return [=](double s, Truth* t) { t->effects.sensor.outliers = {probability, 20 * y * s}; };
  if (name == "sens_clip")
    return [=](double s, Truth* t) { t->effects.sensor.clip = {y_max * remaining(s), coin}; };
  if (name == "sens_quant")
    return [=](double s, Truth* t) { t->effects.sensor.quant = {4 * y * s}; };
  if (name == "sens_dropout")
    return [=](double s, Truth* t) { t->effects.sensor.dropout = {0.9 * s}; };
  return {};
}

SetSize drawNoiseEffect(const std::string& name, const SignalScale& scale, std::mt19937_64& random,
                        const Truth& truth) {
  const double direction = sign(random), frequency = uniform(0.3, 2.8, random);
  const bool of_input = chance(0.5, random);
  const double start = uniform(0.2, 0.8, random) * samplesOf(truth);
  if (name == "noise_colour")
    return [=](double s, Truth* t) {
      const double radius = 0.97 * s;
      t->effects.noise.colour = {-2 * radius * std::cos(frequency), radius * radius};
    };
  if (name == "noise_tails")
    return [=](double s, Truth* t) { t->effects.noise.tails = {2.05 + 5 * (1 / s - 1)}; };
  if (name == "noise_hetero")
    return [=](double s, Truth* t) {
      t->effects.noise.hetero = {0.99 * s, of_input ? HeteroDriver::input : HeteroDriver::output,
                                 of_input ? scale.u : scale.y};
    };
  if (name == "noise_step")
    return [=](double s, Truth* t) { t->effects.noise.step = {std::exp(3 * direction * s), start}; };
  return {};
}

SetSize drawExperimentEffect(const std::string& name, const SignalScale& scale,
                             std::mt19937_64& random, const Truth& truth) {
  const double u = scale.u, y = scale.y, direction = sign(random);
  const double pole = uniform(0.2, 0.8, random), weight = uniform(0.2, 0.3, random);
  const Mixture& mixture = truth.error_model.mixture;
  if (name == "exp_feedback")
    return [=](double s, Truth* t) { t->effects.experiment.feedback = {3 * s * u / y}; };
  if (name == "exp_mode") {
    const Eigen::VectorXd centre = mixture.mean(), away = directionOf(mixture.dimension(), random);
    const double deviation = std::sqrt(mixture.covariances.front()(0, 0));
    return [=](double s, Truth* t) {
      t->effects.experiment.mode = {weight, centre + 4 * s * away, deviation};
    };
  }
  if (name == "exp_input2")
    return [=](double s, Truth* t) { t->effects.experiment.input2 = {3 * y * direction * s, pole}; };
  if (name == "exp_clock")
    return [=](double s, Truth* t) { t->effects.experiment.clock = {4 * s}; };
  if (name == "exp_jitter")
    return [=](double s, Truth* t) { t->effects.experiment.jitter = {0.45 * s, 1}; };
  return {};
}

SetSize drawUnnamedEffect(const std::string& name, const SignalScale& scale,
                          std::mt19937_64& random) {
  const double u = scale.u, y = scale.y;
  const double switching = uniform(0.01, 0.1, random), angle = uniform(0.3, 0.7, random) * y,
               bursting = uniform(0.005, 0.02, random), frequency = uniform(0.3, 2.5, random),
               radius = uniform(0.8, 0.95, random);
  if (name == "unk_telegraph")
    return [=](double s, Truth* t) { t->effects.unnamed.telegraph = {0.95 * s, switching}; };
  if (name == "unk_bilinear")
    return [=](double s, Truth* t) { t->effects.unnamed.bilinear = {2 * s / y}; };
  if (name == "unk_gravity")
    return [=](double s, Truth* t) { t->effects.unnamed.gravity = {4 * u * s, angle}; };
  if (name == "unk_outflow")
    return [=](double s, Truth* t) { t->effects.unnamed.outflow = {4 * u * s / std::sqrt(y)}; };
  if (name == "unk_rectification")
    return [=](double s, Truth* t) { t->effects.unnamed.rectification = {s}; };
  if (name == "unk_burst")
    return [=](double s, Truth* t) {
      t->effects.unnamed.burst = {20 * y * s, bursting, frequency, radius};
    };
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

}  // namespace uncertainty_identification
