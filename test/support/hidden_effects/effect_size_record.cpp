#include <cmath>

#include "support/hidden_effects/draw.h"
#include "support/hidden_effects/effect_size.h"

/// The effects of the sensor, the noise and the experiments, and those in no catalogue.
namespace uncertainty_identification::test {

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
    return [=](double s, Truth* t) {
      t->effects.sensor.bias = {2 * y * direction * s, coin, 2 * y * s};
    };
  if (name == "sens_drift")
    return [=](double s, Truth* t) {
      t->effects.sensor.drift = {4 * y * direction * s, coin, 4 * y * s};
    };
  if (name == "sens_hum")
    return [=](double s, Truth* t) { t->effects.sensor.hum = {2 * y * s, frequency, angle, coin}; };
  if (name == "sens_lag") return [=](double s, Truth* t) { t->effects.sensor.lag = {0.97 * s}; };
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
  const double start = uniform(0.2, 0.8, random) * truth.samples.front();
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
    return [=](double s, Truth* t) {
      t->effects.noise.step = {std::exp(3 * direction * s), start};
    };
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
    return [=](double s, Truth* t) {
      t->effects.experiment.input2 = {3 * y * direction * s, pole};
    };
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

}  // namespace uncertainty_identification::test
