#include "explanation/from_white_noise.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "math/polynomial.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

Polynomials polynomialsOf(const Fit& fit) {
  const NominalModel& nominal = fit.model->nominal();
  return nominal.polynomials(fit.at.parameters.head(nominal.parameterCount()));
}

/// Whether D has poles of its own, and is not the plant's A.
bool hasNoisePoles(const Polynomials& p) {
  return p.d.size() > 0 && !(p.d.size() == p.a.size() && p.d == p.a);
}

/// Whether a pole and a zero of the noise model are so near the unit circle that the noise model
/// may describe a bias, a drift or a hum. A pole alone describes a noise that drifts.
bool absorbsWhatPersists(const Polynomials& p) {
  constexpr double kPole = 0.98, kZero = 0.9;
  return p.c.size() > 0 && roots(p.d).cwiseAbs().maxCoeff() > kPole &&
         roots(p.c).cwiseAbs().maxCoeff() > kZero;
}

/// The base's parameters with C = D = 1. The last parameters of the nominal model are those of C
/// and D.
ModelParameters withWhiteNoise(const Fit& base, const Polynomials& p) {
  const Index noise = p.c.size() + p.d.size();
  ModelParameters at = base.at;
  at.parameters.segment(base.model->nominal().parameterCount() - noise, noise).setZero();
  return at;
}

/// The effects that the screening on top of white noise finds most promising, fitted.
std::vector<FittedEffect> mostPromising(const Fit& white, const Fit& base, const FitData& data,
                                        const Effects& effects, const FitContext& context) {
  constexpr std::size_t kFitted = 7;
  FitEffort to_convergence;
  to_convergence.steps = 15;
  to_convergence.search_grid = true;
  std::vector<FittedEffect> fitted = screenedEffects(white, data, effects, context);
  fitted.resize(std::min(kFitted, fitted.size()));
  for (FittedEffect& each : fitted)
    each.score = -std::numeric_limits<double>::infinity();  // the screening's is over `white`
  inParallel(context, fitted.size(), [&](std::size_t k) {
    converge(&fitted[k], afterPredictedStep(fitted[k], data, context), base, data, context,
             to_convergence);
  });
  return fitted;
}

}  // namespace

std::vector<FittedEffect> fittedFromWhiteNoise(const Fit& base, const FitData& data,
                                               const Effects& effects, const FitContext& context) {
  constexpr int kMixtureSteps = 20;
  const Polynomials p = polynomialsOf(base);
  if (!hasNoisePoles(p)) return {};
  const Fit white =
      mixtureFitted(base.model, withWhiteNoise(base, p), data, context.options, kMixtureSteps);
  if (!std::isfinite(white.log_likelihood)) return {};
  std::vector<FittedEffect> fitted;
  if (absorbsWhatPersists(p)) fitted = mostPromising(white, base, data, effects, context);
  Effects colour;
  std::copy_if(effects.begin(), effects.end(), std::back_inserter(colour),
               [](const auto& effect) { return effect->has(Trait::noise_poles); });
  for (const FittedEffect& screened : screenedEffects(white, data, colour, context))
    fitted.push_back(fittedFromEachStart(screened, white.at, base, data, context));
  return fitted;
}

}  // namespace uncertainty_identification
