#include "uncertainty_identification/bounds/uncertainty_weight.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "bounds/magnitude_fit.h"
#include "bounds/structure_bound.h"
#include "math/interruption.h"
#include "math/polynomial.h"
#include "uncertainty_identification/bounds/bands.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;

constexpr int kCheckFrequencies = 10000;
constexpr double kFloor = 1e-3;       // smallest bound that counts, as a share of the peak
constexpr double kEnough = 1.1;       // median |W|/bound at which the order is high enough
constexpr int kLargestAutomatic = 6;  // highest order tried with weight_order: auto
constexpr Index kFitPoints = 200;

/// Check frequencies over the range of the grid: half of them logarithmically, half linearly
/// spaced, so that both ends are covered densely.
VectorXd checkFrequencies(const VectorXd& omega) {
  const double low = omega[0], high = omega[omega.size() - 1];
  VectorXd all(kCheckFrequencies);
  const int half = kCheckFrequencies / 2;
  all.head(half) = VectorXd::LinSpaced(half, std::log(low), std::log(high)).array().exp();
  all.tail(half) = VectorXd::LinSpaced(half, low, high);
  std::sort(all.data(), all.data() + all.size());
  all[kCheckFrequencies - 1] = high;
  return all;
}

/// Calls body(k, |G/Go - 1| of all draws) at each frequency omega_k.
template <class Body>
void forRelativeErrors(const PlantSamples& drawn, const PlantSamples& nominal,
                       const VectorXd& omega, const Body& body) {
  constexpr Index kAtOnce = 8;
  ResponseSweep of_drawn(drawn), of_nominal(nominal);
  ArrayXd distance(drawn.count());
  for (Index first = 0; first < omega.size(); first += kAtOnce) {
    checkpoint();
    const VectorXd at = omega.segment(first, std::min(kAtOnce, omega.size() - first));
    const ComplexResponses& all = of_drawn.at(at);
    const ComplexResponses& go = of_nominal.at(at);
    for (Index k = 0; k < at.size(); ++k) {
      const double scale = 1 / std::max(std::hypot(go.real(0, k), go.imaginary(0, k)), 1e-300);
      distance = ((all.real.col(k).array() - go.real(0, k)).square() +
                  (all.imaginary.col(k).array() - go.imaginary(0, k)).square())
                     .sqrt() *
                 scale;
      body(first + k, distance);
    }
  }
}

VectorXd simultaneousBound(const PlantSamples& drawn, const PlantSamples& nominal,
                           const VectorXd& omega, double level) {
  BandBuilder builder({level}, drawn.count(), omega.size(), Sides::upper, 1e-12F);
  forRelativeErrors(drawn, nominal, omega,
                    [&](Index, const ArrayXd& errors) { builder.add(errors.cast<float>()); });
  return builder.bands().simultaneous[0].upper;
}

double shareBelow(const PlantSamples& drawn, const PlantSamples& nominal, const VectorXd& omega,
                  const ArrayXd& limit) {
  Eigen::Array<bool, Eigen::Dynamic, 1> below =
      Eigen::Array<bool, Eigen::Dynamic, 1>::Constant(drawn.count(), true);
  forRelativeErrors(drawn, nominal, omega,
                    [&](Index k, const ArrayXd& errors) { below = below && errors <= limit[k]; });
  return below.cast<double>().mean();
}

/// An evenly spaced subset of about `count` entries that includes the last one.
VectorXd thinned(const VectorXd& all, Index count) {
  if (all.size() <= count) return all;
  return VectorXd::NullaryExpr(count,
                               [&](Index k) { return all[k * (all.size() - 1) / (count - 1)]; });
}

/// The bound at the frequencies `at`, interpolated between the check frequencies on logarithmic
/// axes.
VectorXd interpolated(const VectorXd& omega, const VectorXd& bound, const VectorXd& at) {
  VectorXd out(at.size());
  for (Index k = 0; k < at.size(); ++k) {
    const double* upper = std::upper_bound(omega.data(), omega.data() + omega.size(), at[k]);
    const Index j = std::min<Index>(std::max<Index>(upper - omega.data(), 1), omega.size() - 1);
    const double step = omega[j] - omega[j - 1];
    const double share = step > 0 ? std::min((at[k] - omega[j - 1]) / step, 1.0) : 1.0;
    out[k] = bound[j - 1] + share * (bound[j] - bound[j - 1]);
  }
  return out;
}

/// Tustin's substitution for a polynomial in z^-1: returns its coefficients in s.
VectorXd tustin(const VectorXd& in_z_inverse, double sample_time) {
  const Index order = in_z_inverse.size() - 1;
  const double half = sample_time / 2;
  VectorXd ascending = VectorXd::Zero(order + 1);
  for (Index k = 0; k <= order; ++k) {  // (1 - s T/2)^k (1 + s T/2)^(order - k)
    VectorXd product = VectorXd::Unit(order + 1, 0);
    for (Index factor = 0; factor < order; ++factor) {
      const double slope = factor < k ? -half : half;
      for (Index power = order; power > 0; --power) product[power] += slope * product[power - 1];
    }
    ascending += in_z_inverse[k] * product;
  }
  return ascending.reverse();
}

double median(const ArrayXd& values) {
  std::vector<double> sorted(values.data(), values.data() + values.size());
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<long>(sorted.size() / 2),
                   sorted.end());
  return sorted[sorted.size() / 2];
}

void describe(const MinimumPhase& fit, double sample_time, UncertaintyWeight* weight) {
  weight->order = fit.order();
  weight->num = fit.gain * withLeadingOne(fit.n);
  weight->den = withLeadingOne(fit.d);
  weight->continuous_num = tustin(weight->num, sample_time);
  weight->continuous_den = tustin(weight->den, sample_time);
  const double leading = weight->continuous_den[0];
  if (leading != 0) {
    weight->continuous_num /= leading;
    weight->continuous_den /= leading;
  }
}

/// Increases the order until the fit exceeds the bound only a little, the order reaches `order`, or
/// no fit of the next order is found.
MinimumPhase fitOfLeastOrder(const VectorXd& angles, const VectorXd& log_bound, int order) {
  MinimumPhase fit = fitAbove(angles, log_bound, 0, MinimumPhase());
  const int last = order == kAutomatic ? kLargestAutomatic : order;
  for (int k = 1; k <= last; ++k) {
    const ArrayXd excess = fit.logMagnitude(angles) - log_bound.array();
    if (order == kAutomatic && median(excess) < std::log(kEnough)) break;
    fit = fitAbove(angles, log_bound, k, fit);
    if (fit.order() < k) break;
  }
  return fit;
}

}  // namespace

ArrayXd magnitudeOf(const UncertaintyWeight& weight, const VectorXd& omega, double sample_time) {
  const MinimumPhase fit{weight.num[0], weight.num.tail(weight.order) / weight.num[0],
                         weight.den.tail(weight.order)};
  return fit.logMagnitude(omega * sample_time).exp();
}

UncertaintyWeight uncertaintyWeight(const PlantDistribution& plants, const VectorXd& omega,
                                    const BoundsOptions& options, std::uint64_t seed) {
  const double sample_time = plants.nominal().sample_time;
  const PlantSamples drawn =
      plants.draw(options.samples,
                  plants.hasEstimationErrors() ? Uncertainty::total : Uncertainty::mixture, seed);
  const VectorXd check = checkFrequencies(omega);
  const VectorXd of_draws = simultaneousBound(drawn, plants.nominal(), check, options.weight_level);
  const VectorXd of_structure =
      structureBound(plants.structureError(), check, options.weight_level);
  const VectorXd bound = (of_draws.array().square() + of_structure.array().square()).sqrt();
  if (!(bound.maxCoeff() > 1e-9)) {
    throw DataError("the plants do not differ from the nominal model, so no weight is needed");
  }
  if (!bound.allFinite() || bound.maxCoeff() > 1e20) {
    throw DataError("the estimation errors are too large for a weight to be computed");
  }
  UncertaintyWeight weight;
  weight.level = options.weight_level;
  weight.floor = kFloor * bound.maxCoeff();
  weight.check_frequencies = kCheckFrequencies;
  weight.omega = omega;
  weight.bound = interpolated(check, bound, omega);
  const VectorXd at = thinned(omega, kFitPoints);
  const VectorXd log_bound = interpolated(check, bound, at).cwiseMax(weight.floor).array().log();
  MinimumPhase fit = fitOfLeastOrder(at * sample_time, log_bound, options.weight_order);
  const ArrayXd excess =
      fit.logMagnitude(check * sample_time) - bound.cwiseMax(weight.floor).array().log();
  fit.gain *= std::exp(-excess.minCoeff()) * (1 + 1e-9);
  describe(fit, sample_time, &weight);

  const ArrayXd magnitude = magnitudeOf(weight, check, sample_time);
  weight.margin = (magnitude / bound.cwiseMax(weight.floor).array()).minCoeff();
  weight.level_held = shareBelow(drawn, plants.nominal(), check, magnitude);
  std::vector<double> ratios;
  const ArrayXd on_grid = magnitudeOf(weight, omega, sample_time);
  for (Index k = 0; k < omega.size(); ++k) {
    if (weight.bound[k] >= weight.floor) ratios.push_back(on_grid[k] / weight.bound[k]);
  }
  const Eigen::Map<const ArrayXd> all(ratios.data(), static_cast<Index>(ratios.size()));
  weight.over_bounding_median = median(all);
  weight.over_bounding_max = all.maxCoeff();
  return weight;
}

}  // namespace uncertainty_identification
