#include "bounds/magnitude_fit.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <nlopt.hpp>
#include <optional>
#include <vector>

#include "math/interruption.h"
#include "math/polynomial.h"

namespace uncertainty_identification {
namespace {

using Eigen::ArrayXcd;
using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

ArrayXcd valuesOf(const VectorXd& monic, const ArrayXcd& z_inverse) {
  ArrayXcd value = ArrayXcd::Zero(z_inverse.size());
  for (Index k = monic.size() - 1; k >= 0; --k) value = (value + monic[k]) * z_inverse;
  return value + 1.0;
}

ArrayXcd inverses(const VectorXd& angles) {
  return angles.array().unaryExpr([](double x) { return std::polar(1.0, -x); });
}

/// The objective: mean excess of log|N/D| over log bound after N/D has been scaled up until it is
/// nowhere below the bound. The scaling is a smooth approximation of the maximum:
///   f = mean r + log(mean exp(-sharpness r))/sharpness, r = log|N/D| - log bound.
class Excess {
 public:
  Excess(const VectorXd& angles, const VectorXd& log_bound, int order, double sharpness)
      : z_inverse_(inverses(angles)), log_bound_(log_bound), order_(order), sharpness_(sharpness) {}

  static double evaluate(const std::vector<double>& x, std::vector<double>& gradient, void* self) {
    return static_cast<const Excess*>(self)->value(x, &gradient);
  }

  double value(const std::vector<double>& x, std::vector<double>* gradient) const {
    checkpoint();
    const Eigen::Map<const VectorXd> all(x.data(), 2 * order_);
    MatrixXd to_n, to_d;
    const VectorXd n = fromUnbounded(all.head(order_), &to_n);
    const VectorXd d = fromUnbounded(all.tail(order_), &to_d);
    const ArrayXcd N = valuesOf(n, z_inverse_), D = valuesOf(d, z_inverse_);
    const ArrayXd r = N.abs().max(1e-300).log() - D.abs().max(1e-300).log() - log_bound_;
    const double lowest = r.minCoeff();
    const ArrayXd weights = (-sharpness_ * (r - lowest)).exp();
    const double total = weights.sum(), count = static_cast<double>(r.size());
    if (!gradient->empty()) {
      const ArrayXd slope = 1 / count - weights / total;  // df/dr
      Eigen::Map<VectorXd> out(gradient->data(), 2 * order_);
      out.head(order_) = to_n.transpose() * toCoefficients(slope, N);
      out.tail(order_) = -to_d.transpose() * toCoefficients(slope, D);
    }
    return r.mean() - lowest + std::log(total / count) / sharpness_;
  }

 private:
  /// Chain rule to the coefficients of P: sum of slope d log|P|/dp_k = slope Re(z^-k/P).
  VectorXd toCoefficients(const ArrayXd& slope, const ArrayXcd& P) const {
    VectorXd out(order_);
    ArrayXcd power = z_inverse_ / P;
    for (int k = 0; k < order_; ++k, power *= z_inverse_) out[k] = (slope * power.real()).sum();
    return out;
  }

  ArrayXcd z_inverse_;
  ArrayXd log_bound_;
  int order_;
  double sharpness_;
};

/// Minimises the objective for increasing sharpness. `x` holds the start and receives the result.
/// Returns the excess with the exact maximum.
double minimise(const VectorXd& angles, const VectorXd& log_bound, int order,
                std::vector<double>* x) {
  for (double sharpness : {3.0, 30.0, 300.0, 3000.0}) {
    const Excess excess(angles, log_bound, order, sharpness);
    nlopt::opt optimiser(nlopt::LD_LBFGS, static_cast<unsigned>(x->size()));
    optimiser.set_min_objective(&Excess::evaluate, const_cast<Excess*>(&excess));
    optimiser.set_lower_bounds(-8.0);  // reflection coefficients within 1e-7 of the unit circle
    optimiser.set_upper_bounds(8.0);
    optimiser.set_maxeval(150);
    optimiser.set_ftol_abs(1e-7);
    std::vector<double> at = *x;
    double reached = 0;
    std::vector<double> none;
    const double before = excess.value(at, &none);
    try {
      optimiser.optimize(at, reached);
    } catch (const std::runtime_error&) {  // the line search found no better point
    }
    if (excess.value(at, &none) < before) *x = at;
  }
  std::vector<double> none;
  return Excess(angles, log_bound, order, 1e6).value(*x, &none);
}

VectorXd clampedCoordinates(const VectorXd& monic) {
  return toUnbounded(monic).cwiseMax(-7.9).cwiseMin(7.9);
}

/// The fit of the lower order with one more zero and one more pole, at slightly different angles.
/// Absent if rounding moves roots that are close to the unit circle across it.
std::optional<std::vector<double>> extended(const MinimumPhase& lower, double zero, double pole) {
  const VectorXd more_n = multiply(lower.n, VectorXd::Constant(1, -std::exp(-zero)));
  const VectorXd more_d = multiply(lower.d, VectorXd::Constant(1, -std::exp(-pole)));
  if (!isStable(more_n) || !isStable(more_d)) return {};
  const VectorXd n = clampedCoordinates(more_n), d = clampedCoordinates(more_d);
  std::vector<double> x(n.data(), n.data() + n.size());
  x.insert(x.end(), d.data(), d.data() + d.size());
  return x;
}

}  // namespace

ArrayXd MinimumPhase::logMagnitude(const VectorXd& angles) const {
  const ArrayXcd z_inverse = inverses(angles);
  return std::log(std::abs(gain)) + valuesOf(n, z_inverse).abs().max(1e-300).log() -
         valuesOf(d, z_inverse).abs().max(1e-300).log();
}

MinimumPhase fitAbove(const VectorXd& angles, const VectorXd& log_bound, int order,
                      const MinimumPhase& lower) {
  MinimumPhase best = lower;
  if (order > 0) {
    const double low = std::log(angles[0]), high = std::log(angles[angles.size() - 1]);
    double least = std::numeric_limits<double>::infinity();
    for (double share : {0.15, 0.4, 0.65, 0.9}) {
      for (double apart : {2.0, 0.5}) {
        const double at = std::exp(low + share * (high - low));
        std::optional<std::vector<double>> x = extended(lower, at * apart, at / apart);
        if (!x) continue;
        const double excess = minimise(angles, log_bound, order, &*x);
        if (!(excess < least)) continue;
        least = excess;
        const Eigen::Map<const VectorXd> all(x->data(), 2 * order);
        best.n = fromUnbounded(all.head(order));
        best.d = fromUnbounded(all.tail(order));
      }
    }
  }
  best.gain = 1;
  best.gain = std::exp(-(best.logMagnitude(angles) - log_bound.array()).minCoeff());
  return best;
}

}  // namespace uncertainty_identification
