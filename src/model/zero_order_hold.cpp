#include "model/zero_order_hold.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

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

/// A system x' = A x + b u that is held for a time, or a derivative of these three.
template <int order>
struct Held {
  Matrix<double, order> A;
  Vector<double, order> b;
  double time = 0;
};

/// Both by their Taylor series over a time so short that it converges at once, which is doubled
/// then; the first system's, then their derivatives in the directions of the others. `time` in
/// sample times. Derivatives with respect to physical parameters ask for very many of these, so
/// the derivatives are products of plain matrices: duals take several times as long.
template <int order>
std::vector<Hold<double, order>> hold(const std::vector<Held<order>>& systems) {
  constexpr int kTerms = 13;  // 0.5^14/14! is below the rounding error
  const auto& [A, b, time] = systems.front();
  const Index n = A.rows();
  const double norm = time * A.cwiseAbs().colwise().sum().maxCoeff();
  const bool finite = std::isfinite(norm);
  const int doublings = finite && norm > 0.5 ? std::ilogb(norm) + 2 : 0;
  const double part = finite ? std::ldexp(1.0, -doublings) : kNotANumber;
  std::vector<Matrix<double, order>> scaled;
  std::vector<Hold<double, order>> held;
  for (const Held<order>& of : systems) {
    scaled.push_back(part * (of.A * time + A * of.time));
    held.push_back({Matrix<double, order>::Zero(n, n), of.b});
  }
  scaled.front() = A * (time * part);
  held.front().transition.setIdentity();
  Matrix<double, order>& transition = held.front().transition;
  Vector<double, order>& input = held.front().input;
  for (int k = kTerms; k > 0; --k) {
    const double share = 1.0 / k;
    for (std::size_t j = held.size(); j-- > 0;) {  // the value last: its derivatives need the old
      Hold<double, order>& of = held[j];
      Matrix<double, order> product = scaled.front() * of.transition;
      Vector<double, order> driven = scaled.front() * of.input;
      if (j > 0) {
        product += scaled[j] * transition;
        driven += scaled[j] * input;
      }
      of.transition = product * share;
      if (k > 1) of.input = systems[j].b + driven * share;
    }
    transition.diagonal().array() += 1;
  }
  for (std::size_t j = held.size(); j-- > 1;)
    held[j].input = part * (time * held[j].input + systems[j].time * input);
  input *= time * part;
  for (int k = 0; k < doublings; ++k) {
    for (std::size_t j = held.size(); j-- > 1;) {
      Hold<double, order>& of = held[j];
      of.input += (transition * of.input + of.transition * input).eval();
      of.transition = (transition * of.transition + of.transition * transition).eval();
    }
    input += (transition * input).eval();
    transition = (transition * transition).eval();
  }
  return held;
}

template <int order>
Hold<double, order> hold(const Matrix<double, order>& A, const Vector<double, order>& b,
                         double time) {
  return hold<order>({{A, b, time}}).front();
}

template <int order>
Hold<Dual, order> hold(const Matrix<Dual, order>& A, const Vector<Dual, order>& b,
                       const Dual& time) {
  const auto value = [](const Dual& x) { return x.value(); };
  std::vector<Held<order>> systems{{A.unaryExpr(value), b.unaryExpr(value), time.value()}};
  std::vector<Index> directions;
  for (Index k = 0; k < time.derivatives().size(); ++k) {
    const auto slope = [k](const Dual& x) { return x.derivatives()[k]; };
    Held<order> of{A.unaryExpr(slope), b.unaryExpr(slope), slope(time)};
    if (of.A.isZero(0) && of.b.isZero(0) && of.time == 0) continue;
    systems.push_back(std::move(of));
    directions.push_back(k);
  }
  const std::vector<Hold<double, order>> held = hold<order>(systems);
  Hold<Dual, order> all{held.front().transition.template cast<Dual>(),
                        held.front().input.template cast<Dual>()};
  for (std::size_t k = 0; k < directions.size(); ++k) {
    const Hold<double, order>& of = held[k + 1];
    for (Index i = 0; i < A.size(); ++i)
      all.transition(i).derivatives()[directions[k]] = of.transition(i);
    for (Index i = 0; i < b.size(); ++i) all.input(i).derivatives()[directions[k]] = of.input(i);
  }
  return all;
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
  const Hold<Scalar, order> newest = hold<order>(A, input, Scalar(1) - fraction);
  Vector<Scalar, order> older = Vector<Scalar, order>::Zero(n);
  Matrix<Scalar, order> transition = newest.transition;
  if (valueOf(fraction) > 0 || (extra > 0 && std::is_same_v<Scalar, Dual>)) {
    const Hold<Scalar, order> before = hold<order>(A, input, fraction);
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
    case 4:
      return of(std::integral_constant<int, 4>());
    case 5:
      return of(std::integral_constant<int, 5>());
    default:
      return of(std::integral_constant<int, Eigen::Dynamic>());
  }
}

template Sampled<double> discretise(const Coefficients<double>&, const Coefficients<double>&,
                                    const double&, int);
template Sampled<Dual> discretise(const Coefficients<Dual>&, const Coefficients<Dual>&, const Dual&,
                                  int);

}  // namespace uncertainty_identification
