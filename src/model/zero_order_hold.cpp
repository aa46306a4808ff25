#include "model/zero_order_hold.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace uncertainty_identification {
namespace {

using Eigen::Index;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

double valueOf(double x) { return x; }
double valueOf(const Dual& x) { return x.value(); }

template <typename Scalar, int rows>
using Matrix = Eigen::Matrix<Scalar, rows, rows>;
template <typename Scalar, int rows>
using Vector = Eigen::Matrix<Scalar, rows, 1>;

/// Zero-order hold over a time: e^(A time), and the integral of e^(A s) b over [0, time].
template <typename Scalar, int order>
struct Hold {
  Matrix<Scalar, order> transition;
  Vector<Scalar, order> input;
};

template <typename Scalar, int order>
double largestColumnSum(const Matrix<Scalar, order>& A) {
  return A.unaryExpr([](const Scalar& x) { return std::abs(valueOf(x)); })
      .colwise()
      .sum()
      .maxCoeff();
}

/// Both by their Taylor series over a time so short that it converges at once, which is doubled
/// then. `time` in sample times. Derivatives with respect to physical parameters ask for very many
/// of these.
template <typename Scalar, int order>
Hold<Scalar, order> hold(const Matrix<Scalar, order>& A, const Vector<Scalar, order>& b,
                         const Scalar& time) {
  constexpr int kTerms = 13;  // 0.5^14/14! is below the rounding error
  const Index n = A.rows();
  const double norm = valueOf(time) * largestColumnSum<Scalar, order>(A);
  if (!std::isfinite(norm)) return {A * Scalar(kNotANumber), b * Scalar(kNotANumber)};
  const int doublings = norm > 0.5 ? std::ilogb(norm) + 2 : 0;
  const Scalar brief = time * Scalar(std::ldexp(1.0, -doublings));
  const Matrix<Scalar, order> scaled = A * brief, one = Matrix<Scalar, order>::Identity(n, n);
  Hold<Scalar, order> held{one, b};
  for (int k = kTerms; k > 0; --k) {
    const Scalar share(1.0 / k);
    held.transition = (one + (scaled * held.transition) * share).eval();
    if (k > 1) held.input = (b + (scaled * held.input) * share).eval();
  }
  held.input *= brief;
  for (int k = 0; k < doublings; ++k) {
    held.input += (held.transition * held.input).eval();
    held.transition = (held.transition * held.transition).eval();
  }
  return held;
}

/// discretise() for a known order, which takes a fraction of the time, or any (Dynamic).
template <typename Scalar, int order>
Sampled<Scalar> discretiseOf(const Coefficients<Scalar>& numerator,
                             const Coefficients<Scalar>& denominator, const Scalar& dead_samples,
                             int extra) {
  const Index n = denominator.size() - 1;
  Matrix<Scalar, order> A =
      Matrix<Scalar, order>::Zero(n, n);  // controllable form, highest power scaled to 1
  A.diagonal(1).setOnes();
  const Scalar leading = Scalar(1) / denominator[n];
  for (Index k = 0; k < n; ++k) A(n - 1, k) = -denominator[k] * leading;
  Vector<Scalar, order> input = Vector<Scalar, order>::Zero(n), output = input;
  input[n - 1] = leading;
  for (Index k = 0; k < numerator.size(); ++k) output[k] = numerator[k];

  const int whole = static_cast<int>(valueOf(dead_samples));
  const Scalar fraction = dead_samples - Scalar(whole);
  // The previous input acts during the fraction of the dead time, the newest one after it.
  const Hold<Scalar, order> newest = hold<Scalar, order>(A, input, Scalar(1) - fraction);
  Vector<Scalar, order> older = Vector<Scalar, order>::Zero(n);
  Matrix<Scalar, order> transition = newest.transition;
  if (valueOf(fraction) > 0 || (extra > 0 && std::is_same_v<Scalar, Dual>)) {
    const Hold<Scalar, order> before = hold<Scalar, order>(A, input, fraction);
    older = newest.transition * before.input;
    transition = newest.transition * before.transition;
  }

  Sampled<Scalar> sampled{Coefficients<Scalar>::Zero(n + extra), Coefficients<Scalar>::Zero(n)};
  Matrix<Scalar, order> adjugate = Matrix<Scalar, order>::Identity(n, n);
  for (Index k = 0; k < n; ++k) {
    const Vector<Scalar, order> by_newest = adjugate * newest.input, by_older = adjugate * older;
    sampled.b[k + std::min(whole, std::max(extra - 1, 0))] += output.dot(by_newest);
    if (extra > 0) sampled.b[k + std::min(whole, extra - 1) + 1] += output.dot(by_older);
    const Matrix<Scalar, order> product = transition * adjugate;
    sampled.a[k] = -product.trace() * Scalar(1.0 / static_cast<double>(k + 1));
    adjugate = product;
    for (Index i = 0; i < n; ++i) adjugate(i, i) += sampled.a[k];
  }
  return sampled;
}

}  // namespace

template <typename Scalar>
Sampled<Scalar> discretise(const Coefficients<Scalar>& numerator,
                           const Coefficients<Scalar>& denominator, const Scalar& dead_samples,
                           int extra) {
  const auto of = [&](auto order) {
    return discretiseOf<Scalar, decltype(order)::value>(numerator, denominator, dead_samples,
                                                        extra);
  };
  switch (denominator.size() - 1) {
    case 1:
      return of(std::integral_constant<int, 1>());
    case 2:
      return of(std::integral_constant<int, 2>());
    case 3:
      return of(std::integral_constant<int, 3>());
    default:
      return of(std::integral_constant<int, Eigen::Dynamic>());
  }
}

template Sampled<double> discretise(const Coefficients<double>&, const Coefficients<double>&,
                                    const double&, int);
template Sampled<Dual> discretise(const Coefficients<Dual>&, const Coefficients<Dual>&, const Dual&,
                                  int);

}  // namespace uncertainty_identification
