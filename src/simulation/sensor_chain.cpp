#include <cmath>

#include "simulation/chain.h"
#include "simulation/signals.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

VectorXd clipped(double limit, const VectorXd& y) { return y.cwiseMax(-limit).cwiseMin(limit); }

/// The effects that change x before the noise is added.
VectorXd withCurve(const EffectsTruth& effects, VectorXd x) {
  if (const auto& wiener = effects.sensor.wiener)
    x.array() += wiener->quadratic * x.array().square() + wiener->cubic * x.array().cube();
  if (const auto& rectification = effects.unnamed.rectification)
    x += rectification->share * (x.cwiseAbs() - x);
  if (effects.sensor.clip && effects.sensor.clip->before_noise)
    x = clipped(effects.sensor.clip->limit, x);
  return x;
}

/// The sum of the effects that add to x and do not depend on it.
VectorXd disturbance(const ChainContext& context, int samples) {
  const SensorEffects& sensor = context.truth.effects.sensor;
  const EffectDraws& draws = context.system.effects;
  VectorXd sum = VectorXd::Zero(samples);
  if (sensor.bias) sum.array() += sensor.bias->per_experiment ? draws.bias : sensor.bias->bias;
  const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(samples, 0, samples - 1);
  if (sensor.drift)
    sum.array() += (sensor.drift->per_experiment ? draws.drift : sensor.drift->drift) * t / samples;
  if (const auto& hum = sensor.hum) {
    const double phase = hum->per_experiment ? draws.hum_phase : hum->phase;
    sum.array() += hum->amplitude * (hum->frequency * t + phase).sin();
  }
  return sum;
}

/// Oscillations that begin at random times: 1/(1 - 2 radius cos(frequency) q^-1 + radius^2 q^-2) of
/// random impulses.
VectorXd bursts(const BurstTruth& burst, int samples, std::mt19937_64 random) {
  std::uniform_real_distribution<double> uniform;
  std::normal_distribution<double> standard;
  const VectorXd begins = VectorXd::NullaryExpr(samples, [&] {
    const double chance = uniform(random), size = burst.amplitude * standard(random);
    return chance < burst.probability ? size : 0;
  });
  const Eigen::Vector2d ringing(-2 * burst.radius * std::cos(burst.frequency),
                                burst.radius * burst.radius);
  return filtered(VectorXd::Ones(1), ringing, 0, begins);
}

void addOutliers(const OutliersTruth& outliers, std::mt19937_64 random, VectorXd* y) {
  std::uniform_real_distribution<double> uniform;
  std::normal_distribution<double> standard;
  for (Eigen::Index k = 0; k < y->size(); ++k) {
    const double chance = uniform(random), size = outliers.size * standard(random);
    if (chance < outliers.probability) (*y)(k) += size;
  }
}

void repeatSamples(const DropoutTruth& dropout, std::mt19937_64 random, VectorXd* y) {
  std::uniform_real_distribution<double> uniform;
  for (Eigen::Index k = 1; k < y->size(); ++k)
    if (uniform(random) < dropout.probability) (*y)(k) = (*y)(k - 1);
}

}  // namespace

VectorXd sampledOutput(const ChainContext& context, const VectorXd& x) {
  const ExperimentEffects& effects = context.truth.effects.experiment;
  if (!effects.clock && !effects.jitter) return x;
  VectorXd shift = VectorXd::Constant(x.size(), context.system.effects.clock_shift);
  if (effects.jitter) {
    const double samples_per_second = 1 / context.truth.sample_time;
    shift += effects.jitter->coupling * samples_per_second * context.experiment.stamp_offset;
  }
  return resampledAt(x, shift);
}

VectorXd measured(const ChainContext& context, const VectorXd& x, const VectorXd& v) {
  const SensorEffects& sensor = context.truth.effects.sensor;
  const auto samples = static_cast<int>(x.size());
  VectorXd y = withCurve(context.truth.effects, x) + disturbance(context, samples) + v;
  if (const auto& burst = context.truth.effects.unnamed.burst)
    y += bursts(*burst, samples, context.stream(RandomPurpose::burst));
  if (sensor.lag) y = lagged(sensor.lag->pole, y);
  if (sensor.outliers) addOutliers(*sensor.outliers, context.stream(RandomPurpose::outliers), &y);
  if (sensor.clip && !sensor.clip->before_noise) y = clipped(sensor.clip->limit, y);
  if (sensor.quant) y = quantised(sensor.quant->step, y);
  if (sensor.dropout) repeatSamples(*sensor.dropout, context.stream(RandomPurpose::dropout), &y);
  return y;
}

}  // namespace uncertainty_identification
