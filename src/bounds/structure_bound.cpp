#include "bounds/structure_bound.h"

#include <algorithm>
#include <cmath>

#include "math/constants.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kLargest = 10;

/// Calls body(k, bound at k, &band) for all bands and frequencies.
template <class Body>
void forBounds(const StructureError& error, const VectorXd& omega, Bands* bands, const Body& body) {
  for (std::vector<Band>* list : {&bands->pointwise, &bands->simultaneous}) {
    for (Band& band : *list) {
      const VectorXd bound = structureBound(error, omega, band.level);
      for (Index k = 0; k < omega.size(); ++k) body(k, bound[k], &band);
    }
  }
}

}  // namespace

void widen(double center, double by, double* lower, double* upper) {
  const double from = std::clamp(center, *lower, *upper);
  *lower = from - std::hypot(from - *lower, by);
  *upper = from + std::hypot(*upper - from, by);
}

VectorXd structureBound(const StructureError& error, const VectorXd& omega, double level) {
  const Index points = error.omega.size();
  if (points == 0) return VectorXd::Zero(omega.size());
  const double quantile = std::sqrt(-std::log1p(-level));
  const double *begin = error.omega.data(), *end = begin + points;
  return omega.unaryExpr([&](double at) {
    const Index after = std::clamp<Index>(std::upper_bound(begin, end, at) - begin, 1,
                                          std::max<Index>(points - 1, 1));
    const Index next = std::min(after, points - 1);
    const double step = std::log(error.omega[next] / error.omega[after - 1]);
    const double share =
        step > 0 ? std::clamp(std::log(at / error.omega[after - 1]) / step, 0.0, 1.0) : 0;
    const double log_error = (1 - share) * std::log(std::max(error.relative[after - 1], 1e-300)) +
                             share * std::log(std::max(error.relative[next], 1e-300));
    return std::min(quantile * std::exp(log_error), kLargest);
  });
}

namespace {

std::optional<double> hiddenFrom(const StructureError& error, const VectorXd& omega) {
  constexpr double kLevel = 0.95;
  const VectorXd bound = structureBound(error, omega, kLevel);
  Index from = omega.size();
  while (from > 0 && bound[from - 1] >= 1) --from;
  return from < omega.size() ? std::optional(omega[from]) : std::nullopt;
}

}  // namespace

void addStructureError(const StructureError& error, FrequencyBounds* bounds) {
  if (error.omega.size() == 0) return;
  forBounds(error, bounds->omega, &bounds->magnitude_bands.total,
            [&](Index k, double by, Band* band) {
              const double magnitude = bounds->magnitude[k];
              widen(magnitude, by * magnitude, &band->lower[k], &band->upper[k]);
              band->lower[k] = std::max(band->lower[k], 0.0);
            });
  forBounds(error, bounds->omega, &bounds->phase_bands.total, [&](Index k, double by, Band* band) {
    const double phase = bounds->phase[k];
    widen(phase, by < 1 ? std::asin(by) : kPi, &band->lower[k], &band->upper[k]);
    band->lower[k] = std::max(band->lower[k], phase - kPi);
    band->upper[k] = std::min(band->upper[k], phase + kPi);
  });
  bounds->hidden_from = hiddenFrom(error, bounds->omega);
  forBounds(
      error, bounds->omega, &bounds->relative_error.total,
      [&](Index k, double by, Band* band) { band->upper[k] = std::hypot(band->upper[k], by); });
}

}  // namespace uncertainty_identification
