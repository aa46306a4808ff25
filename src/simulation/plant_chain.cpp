#include <algorithm>
#include <cmath>
#include <vector>

#include "simulation/chain.h"
#include "simulation/signals.h"
#include "uncertainty_identification/model/block.h"
#include "uncertainty_identification/model/error_basis.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// A signal of +1 and -1 that switches with this probability at each sample.
VectorXd telegraph(double probability, int samples, std::mt19937_64 random) {
  std::uniform_real_distribution<double> uniform;
  double state = uniform(random) < 0.5 ? -1 : 1;
  return VectorXd::NullaryExpr(samples, [&] {
    if (uniform(random) < probability) state = -state;
    return state;
  });
}

/// Multiplies the input of the plant by the gains that change during an experiment.
VectorXd driven(const ChainContext& context, VectorXd u) {
  const auto samples = static_cast<int>(u.size());
  const EffectsTruth& effects = context.truth.effects;
  if (const auto& drift = effects.plant.drift)
    u.array() *=
        1 + drift->slope * (Eigen::ArrayXd::LinSpaced(samples, 0, samples - 1) / samples - 0.5);
  if (const auto& temp = effects.plant.temp) {
    const VectorXd& signal = context.experiment.signals.at("temp");
    u.array() *= 1 + temp->coefficient * (signal.array() - temp->reference) / 10;
  }
  if (const auto& gain = effects.unnamed.telegraph) {
    const auto random = context.stream(RandomPurpose::telegraph);
    u.array() *= 1 + gain->depth * telegraph(gain->probability, samples, random).array();
  }
  return u;
}

/// The signal filtered by 1 + GDelta.
VectorXd withError(const ChainContext& context, const VectorXd& nominal) {
  if (!context.system.component) return nominal;
  Signals block = Signals::Zero(kLanes, nominal.size());
  block.row(0) = nominal.array();
  std::vector<Signals> regressors;
  ErrorBasis(context.truth.error_model.basis).apply(block, &regressors);
  VectorXd output = nominal;
  for (std::size_t i = 0; i < regressors.size(); ++i) {
    output +=
        context.system.xi(static_cast<Eigen::Index>(i)) * regressors[i].row(0).matrix().transpose();
  }
  return output;
}

/// The input f of the linear part when the plant's output is x, and was `before` one sample
/// earlier.
double loopDrive(const EffectsTruth& effects, double u, double x, double before) {
  double f = u;
  if (const auto& cubic = effects.plant.cubic) f -= cubic->coefficient * x * x * x;
  if (const auto& coulomb = effects.plant.coulomb)
    f -= coulomb->friction * std::tanh((x - before) / coulomb->smoothing);
  if (const auto& bilinear = effects.unnamed.bilinear) f += bilinear->coefficient * u * x;
  if (const auto& gravity = effects.unnamed.gravity)
    f -= gravity->torque * std::sin(x / gravity->angle);
  if (const auto& outflow = effects.unnamed.outflow)
    f -= outflow->coefficient * std::copysign(std::sqrt(std::abs(x)), x);
  return f;
}

/// Solves A x = q^-delay B f sample by sample, where f depends on x. The delay must be 1 or above.
VectorXd loopOutput(const EffectsTruth& effects, const Polynomials& plant, const VectorXd& u) {
  const auto samples = static_cast<int>(u.size());
  VectorXd x = VectorXd::Zero(samples), f(samples);
  for (int t = 0; t < samples; ++t) {
    for (int i = 1; i <= std::min<int>(t, static_cast<int>(plant.a.size())); ++i)
      x(t) -= plant.a(i - 1) * x(t - i);
    for (int j = 0; j < plant.b.size() && t - plant.delay - j >= 0; ++j)
      x(t) += plant.b(j) * f(t - plant.delay - j);
    f(t) = loopDrive(effects, u(t), x(t), t > 0 ? x(t - 1) : 0);
  }
  return x;
}

/// What plant_resonance adds to the plant's output.
VectorXd resonant(const ResonanceTruth& mode, const VectorXd& u) {
  const Eigen::Vector2d denominator(-2 * mode.radius * std::cos(mode.frequency),
                                    mode.radius * mode.radius);
  return filtered(Eigen::Vector2d(mode.g1, mode.g2), denominator, 1, u);
}

/// Go with its relative error. Effects that feed x back to f need the output sample by sample; the
/// relative error, which is linear, then acts on the input.
VectorXd linearOutput(const ChainContext& context, const VectorXd& u) {
  const Polynomials& plant = context.system.polynomials;
  const auto& resonance = context.truth.effects.plant.resonance;
  if (context.truth.effects.feedsBack()) {
    const VectorXd with_error = withError(context, u);
    VectorXd x = loopOutput(context.truth.effects, plant, with_error);
    if (resonance) x += resonant(*resonance, with_error);
    return x;
  }
  VectorXd nominal = filtered(plant.b, plant.a, plant.delay, u);
  if (resonance) nominal += resonant(*resonance, u);
  return withError(context, nominal);
}

}  // namespace

VectorXd plantOutput(const ChainContext& context, const VectorXd& u) {
  const EffectsTruth& effects = context.truth.effects;
  VectorXd x = linearOutput(context, driven(context, actuated(effects.actuator, u)));
  if (effects.plant.pole) x = lagged(effects.plant.pole->pole, x);
  if (const auto& second = effects.experiment.input2) {
    const VectorXd& d = context.experiment.signals.at("d");
    x += second->gain * lagged(second->pole, delayed(d, 1));
  }
  if (effects.plant.init) {
    const VectorXd impulse = context.system.effects.initial_state * VectorXd::Unit(x.size(), 0);
    x += filtered(VectorXd::Ones(1), context.system.polynomials.a, 0, impulse);
  }
  return x;
}

}  // namespace uncertainty_identification
