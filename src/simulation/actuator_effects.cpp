#include "simulation/actuator_effects.h"

#include <algorithm>
#include <cmath>

#include "simulation/signals.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

VectorXd withDeadZone(const DeadZoneTruth& effect, const VectorXd& u) {
  const double negative = effect.negative_width.value_or(effect.width);
  return u.unaryExpr([&](double value) {
    return value > 0 ? std::max(value - effect.width, 0.0) : std::min(value + negative, 0.0);
  });
}

VectorXd withBacklash(const BacklashTruth& effect, const VectorXd& u) {
  double position = 0;
  return u.unaryExpr([&](double value) {
    position = std::clamp(position, value - effect.width / 2, value + effect.width / 2);
    return position;
  });
}

VectorXd rateLimited(const RateLimitTruth& effect, const VectorXd& u) {
  double position = 0;
  return u.unaryExpr([&](double value) {
    position += std::clamp(value - position, -effect.rate, effect.rate);
    return position;
  });
}

VectorXd withLoss(const LossTruth& effect, VectorXd u) {
  for (int k = 0; k < u.size(); ++k) u(k) *= 1 - effect.loss * onset(k, effect.start);
  return u;
}

}  // namespace

VectorXd actuated(const ActuatorEffects& effects, VectorXd u) {
  if (effects.offset) u.array() += effects.offset->offset;
  if (effects.delay) u = delayed(u, effects.delay->delay);
  if (effects.quantisation) u = quantised(effects.quantisation->step, u);
  if (effects.deadzone) u = withDeadZone(*effects.deadzone, u);
  if (effects.backlash) u = withBacklash(*effects.backlash, u);
  if (effects.ratelimit) u = rateLimited(*effects.ratelimit, u);
  if (effects.saturation)
    u = u.cwiseMax(-effects.saturation->limit).cwiseMin(effects.saturation->limit).eval();
  if (effects.hammerstein) {
    const auto [quadratic, cubic] = *effects.hammerstein;
    u = (u.array() + quadratic * u.array().square() + cubic * u.array().cube()).matrix().eval();
  }
  if (effects.loss) u = withLoss(*effects.loss, u);
  return u;
}

}  // namespace uncertainty_identification
