#include <algorithm>
#include <cmath>
#include <limits>

#include "math/polynomial.h"
#include "simulation/chain.h"
#include "simulation/signals.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// Denominator of the noise model, without the leading 1: D times that of noise_colour.
VectorXd denominator(const Truth& truth) {
  const auto& colour = truth.effects.noise.colour;
  return colour ? multiply(truth.noise.d, Eigen::Vector2d(colour->d1, colour->d2)) : truth.noise.d;
}

/// Number of samples that are simulated before the record begins, so that stationary noise has
/// forgotten its initial state up to rounding.
int warmUp(const NoiseTruth& noise, const VectorXd& d) {
  if (noise.start == NoiseStart::zero) return 0;
  const double slowest = d.size() == 0 ? 0 : roots(d).cwiseAbs().maxCoeff();
  const double decay =
      slowest > 0 ? std::log(std::numeric_limits<double>::epsilon()) / std::log(slowest) : 0;
  return static_cast<int>(noise.c.size() + d.size()) +
         static_cast<int>(std::min(std::ceil(decay), 1e7));
}

/// Turns Gaussian samples into Student's t of the same variance, which is the Gaussian sample times
/// sqrt((nu - 2)/chi^2_nu).
void makeHeavyTailed(double degrees, std::mt19937_64 random, VectorXd* w) {
  std::chi_squared_distribution<double> chi_squared(degrees);
  for (Eigen::Index k = 0; k < w->size(); ++k)
    (*w)(k) *= std::sqrt((degrees - 2) / chi_squared(random));
}

}  // namespace

VectorXd outputNoise(const ChainContext& context, const VectorXd& u, const VectorXd& x) {
  const NoiseTruth& noise = context.truth.noise;
  const NoiseEffects& effects = context.truth.effects.noise;
  const auto samples = static_cast<int>(u.size());
  const VectorXd d = denominator(context.truth);
  std::mt19937_64 random = context.stream(RandomPurpose::noise);
  VectorXd w = gaussian(warmUp(noise, d) + samples, noise.variance, random);
  if (effects.tails)
    makeHeavyTailed(effects.tails->degrees_of_freedom, context.stream(RandomPurpose::tails), &w);
  if (const auto& hetero = effects.hetero) {
    const VectorXd& driver = hetero->driver == HeteroDriver::input ? u : x;
    const auto square = (driver.array() / hetero->scale).square();
    w.tail(samples).array() *= (1 - hetero->share + hetero->share * square).sqrt();
  }
  if (effects.step) {
    auto recorded = w.tail(samples);
    for (int k = 0; k < samples; ++k)
      recorded(k) *= std::pow(effects.step->ratio, onset(k, effects.step->start));
  }
  return filtered(withLeadingOne(noise.c), d, 0, w).tail(samples);
}

}  // namespace uncertainty_identification
