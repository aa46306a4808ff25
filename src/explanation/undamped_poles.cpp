#include "explanation/undamped_poles.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include "math/constants.h"
#include "math/polynomial.h"
#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

/// Whether the polynomial has such a root at `frequency` [rad/sample].
bool hasUndampedRoot(const Eigen::VectorXd& monic, double frequency, double samples) {
  constexpr double kDecay = 0.5;  // time constants in an experiment, at most
  if (monic.size() < 2) return false;
  const Eigen::VectorXcd all = roots(monic);
  for (Eigen::Index k = 0; k < all.size(); ++k) {
    const bool is_undamped = std::abs(all[k]) > std::exp(-kDecay / samples);
    const double resolution = 2 * kPi / samples;
    if (is_undamped && std::abs(std::abs(std::arg(all[k])) - frequency) < resolution) return true;
  }
  return false;
}

}  // namespace

bool neverDecays(const NominalModelEstimate& plant, double samples) {
  return lastingFrequency(plant.a, samples) > 0;
}

bool hasLineAsPoles(const std::vector<Cause>& causes, const NominalModelEstimate& without,
                    double samples) {
  return std::any_of(causes.begin(), causes.end(), [&](const Cause& cause) {
    if (!hasTrait(cause.name, Trait::spectral_line)) return false;
    const auto frequency =
        std::find_if(cause.parameters.begin(), cause.parameters.end(),
                     [](const CauseParameter& each) { return each.name == "frequency"; });
    if (frequency == cause.parameters.end()) return false;
    const double of_sample = frequency->value * without.sample_time;
    return hasUndampedRoot(without.a, of_sample, samples) ||
           hasUndampedRoot(without.d, of_sample, samples);
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
