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

bool hasNoisePoles(const Polynomials& p) {  // of its own: not those of A
  return p.d.size() > 0 && !(p.d.size() == p.a.size() && p.d == p.a);
}

/// A pole and a zero so near the unit circle hold what does not die out. A pole alone is a noise
/// that drifts.
bool holdsWhatPersists(const Polynomials& p) {
  constexpr double kPole = 0.98, kZero = 0.9;
  return p.c.size() > 0 && roots(p.d).cwiseAbs().maxCoeff() > kPole &&
         roots(p.c).cwiseAbs().maxCoeff() > kZero;
}

/// The last parameters of the nominal model are those of C and D.
ModelParameters withWhiteNoise(const Fit& base, const Polynomials& p) {
  const Index noise = p.c.size() + p.d.size();
  ModelParameters at = base.at;
  at.parameters.segment(base.model->nominal().parameterCount() - noise, noise).setZero();
  return at;
}

/// The most promising of all effects.
std::vector<FittedEffect> mostPromising(const Fit& white, const Fit& base, const FitData& data,
                                        const Effects& effects, const FitContext& context) {
  constexpr std::size_t kFitted = 7;
  constexpr int kSteps = 15;
  std::vector<FittedEffect> fitted = screenedEffects(white, data, effects, context);
  fitted.resize(std::min(kFitted, fitted.size()));
  for (FittedEffect& each : fitted)
    each.score = -std::numeric_limits<double>::infinity();  // until it is one over the base
  inParallel(context, fitted.size(), [&](std::size_t k) {
    converge(&fitted[k], afterPredictedStep(fitted[k], data, context), base, data, context, kSteps,
             false);
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
  if (holdsWhatPersists(p)) fitted = mostPromising(white, base, data, effects, context);
  Effects colour;
  std::copy_if(effects.begin(), effects.end(), std::back_inserter(colour),
               [](const auto& effect) { return effect->name() == "noise_colour"; });
  for (const FittedEffect& screened : screenedEffects(white, data, colour, context))
    fitted.push_back(fittedFromEachStart(screened, white.at, base, data, context));
  return fitted;
}

}  // namespace uncertainty_identification
