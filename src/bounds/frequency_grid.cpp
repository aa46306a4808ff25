#include "bounds/frequency_grid.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "math/constants.h"
#include "math/polynomial.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// A peak or notch of the magnitude: normalised frequency and half width [rad/sample].
struct Resonance {
  double at, width;
};

void addResonances(const VectorXd& monic, std::vector<Resonance>* found) {
  const Eigen::VectorXcd all = roots(monic);
  for (Index k = 0; k < all.size(); ++k) {
    const double at = std::arg(all[k]), width = std::abs(std::log(std::abs(all[k])));
    if (at > 0.01 && at < kPi - 0.01 && width < 0.3 * at && width > 0)
      found->push_back({at, std::max(width, 1e-5)});
  }
}

/// B divided by its first nonzero coefficient; empty if B has no zeros.
VectorXd monicNumerator(const VectorXd& b) {
  Index first = 0;
  while (first < b.size() && b[first] == 0) ++first;
  if (first + 1 >= b.size()) return {};
  return b.tail(b.size() - first - 1) / b[first];
}

double lowest(const VectorXd& a) {
  double corner = kPi;
  const Eigen::VectorXcd poles = roots(a);
  for (Index k = 0; k < poles.size(); ++k) {
    if (std::abs(poles[k]) > 0) corner = std::min(corner, std::abs(std::log(poles[k])));
  }
  return std::max(std::min(0.1 * corner, 1e-3 * kPi), 1e-7);
}

}  // namespace

VectorXd frequencyGrid(const NominalModelEstimate& plant, int count) {
  if (count < 10) {
    throw ConfigurationError("bounds.frequencies: found " + std::to_string(count) +
                             "; a grid has at least 10");
  }
  std::vector<Resonance> resonances;
  addResonances(plant.a, &resonances);
  addResonances(monicNumerator(plant.b), &resonances);
  const int of_each =
      resonances.empty() ? 0 : std::min(40, count / (3 * static_cast<int>(resonances.size())));
  std::vector<double> angles;
  for (const Resonance& resonance : resonances) {
    for (int i = 0; i < of_each; ++i) {  // spaced as the quantiles of a Cauchy distribution
      const double spread = std::tan(kPi * ((i + 0.5) / of_each - 0.5));
      const double angle = resonance.at + resonance.width * spread;
      if (angle > lowest(plant.a) && angle < kPi) angles.push_back(angle);
    }
  }
  const int even = count - static_cast<int>(angles.size());
  const double low = std::log(lowest(plant.a)), high = std::log(kPi);
  for (int i = 0; i < even; ++i) angles.push_back(std::exp(low + (high - low) * i / (even - 1)));
  std::sort(angles.begin(), angles.end());
  angles.back() = kPi;
  return Eigen::Map<VectorXd>(angles.data(), count) / plant.sample_time;
}

}  // namespace uncertainty_identification
