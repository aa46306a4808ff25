#include "explanation/undamped_poles.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "explanation/verdict.h"
#include "math/constants.h"
#include "math/polynomial.h"
#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

/// Whether the polynomial has such a root at `frequency` [rad/sample].
bool hasUndampedRoot(const Eigen::VectorXd& monic, double frequency, double samples, double share) {
  if (monic.size() < 2) return false;
  const Eigen::VectorXcd all = roots(monic);
  for (Eigen::Index k = 0; k < all.size(); ++k) {
    const bool is_undamped = std::pow(std::abs(all[k]), samples) > 1 - share;
    const double resolution = 2 * kPi / samples;
    if (is_undamped && std::abs(std::abs(std::arg(all[k])) - frequency) < resolution) return true;
  }
  return false;
}

}  // namespace

bool hasUndampedPoles(const NominalModelEstimate& model, double frequency, double samples,
                      double share) {
  return hasUndampedRoot(model.a, frequency, samples, share) ||
         hasUndampedRoot(model.d, frequency, samples, share);
}

double undampedFrequency(const NominalModelEstimate& model, double samples) {
  constexpr double kPeriods = 3;
  return std::max(lastingFrequency(model.a, samples, kPeriods),
                  lastingFrequency(model.d, samples, kPeriods));
}

bool neverDecays(const NominalModelEstimate& plant, double samples) {
  return lastingFrequency(plant.a, samples) > 0;
}

bool hasLineAsPoles(const std::vector<Cause>& causes, const NominalModelEstimate& without,
                    double samples) {
  constexpr double kShare = 0.4;
  return std::any_of(causes.begin(), causes.end(), [&](const Cause& cause) {
    if (!hasTrait(cause.name, Trait::spectral_line)) return false;
    const auto frequency =
        std::find_if(cause.parameters.begin(), cause.parameters.end(),
                     [](const CauseParameter& each) { return each.name == "frequency"; });
    return frequency != cause.parameters.end() &&
           hasUndampedPoles(without, frequency->value * without.sample_time, samples, kShare);
  });
}

bool standsForALine(const Explanation& explanation, const NominalModelEstimate& without,
                    double samples) {
  if (explanation.causes.empty()) return false;
  const bool is_named = explanation.verdict == Verdict::explained &&
                        hasLineAsPoles(explanation.causes, without, samples);
  return is_named || neverDecays(without, samples);
}

}  // namespace uncertainty_identification
