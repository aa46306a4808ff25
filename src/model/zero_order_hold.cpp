#include "model/zero_order_hold.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

template <int rows>
using Matrix = Eigen::Matrix<double, rows, rows>;
template <int rows>
using Vector = Eigen::Matrix<double, rows, 1>;

/// Zero-order hold over a time: e^(A time), and the integral of e^(A s) b over [0, time].
template <int order>
struct Hold {
  Matrix<order> transition;
  Vector<order> input;
};

/// Both by their Taylor series over a time so short that it converges at once, which is doubled
/// then. `time` in sample times. Derivatives with respect to physical parameters ask for very many
/// of these.
template <int order>
Hold<order> hold(const Matrix<order>& A, const Vector<order>& b, double time) {
  constexpr int kTerms = 13;  // 0.5^14/14! is below the rounding error
  const Index n = A.rows();
  const double norm = time * A.cwiseAbs().colwise().sum().maxCoeff();
  if (!std::isfinite(norm)) return {A * kNotANumber, b * kNotANumber};
  const int doublings = norm > 0.5 ? std::ilogb(norm) + 2 : 0;
  const double brief = std::ldexp(time, -doublings);
  const Matrix<order> scaled = brief * A, one = Matrix<order>::Identity(n, n);
  Hold<order> held{one, b};
  for (int k = kTerms; k > 0; --k) {
    const double share = 1.0 / k;
    held.transition = (one + share * (scaled * held.transition)).eval();
    if (k > 1) held.input = (b + share * (scaled * held.input)).eval();
  }
  held.input *= brief;
  for (int k = 0; k < doublings; ++k) {
    held.input += (held.transition * held.input).eval();
    held.transition = (held.transition * held.transition).eval();
  }
  return held;
}

/// discretise() for a known order, which takes a fraction of the time, or any (Dynamic).
template <int order>
void discretiseOf(const VectorXd& numerator, const VectorXd& denominator, double dead_samples,
                  int extra, Polynomials* p) {
  const Index n = denominator.size() - 1;
  Matrix<order> A = Matrix<order>::Zero(n, n);  // controllable form, highest power scaled to 1
  A.diagonal(1).setOnes();
  A.row(n - 1) = -denominator.head(n).transpose() / denominator[n];
  Vector<order> input = Vector<order>::Zero(n), output = Vector<order>::Zero(n);
  input[n - 1] = 1 / denominator[n];
  for (Index k = 0; k < numerator.size(); ++k) output[k] = numerator[k];

  const int whole = static_cast<int>(dead_samples);
  const double fraction = dead_samples - whole;
  // The previous input acts during the fraction of the dead time, the newest one after it.
  const Hold<order> newest = hold<order>(A, input, 1 - fraction);
  Vector<order> older = Vector<order>::Zero(n);
  Matrix<order> transition = newest.transition;
  if (fraction > 0) {
    const Hold<order> before = hold<order>(A, input, fraction);
    older = newest.transition * before.input;
    transition = newest.transition * before.transition;
  }

  p->a.resize(n);
  p->b = VectorXd::Zero(n + extra);
  Matrix<order> adjugate = Matrix<order>::Identity(n, n);
  for (Index k = 0; k < n; ++k) {
    p->b[k + std::min(whole, std::max(extra - 1, 0))] += output.dot(adjugate * newest.input);
    if (extra > 0) p->b[k + std::min(whole, extra - 1) + 1] += output.dot(adjugate * older);
    const Matrix<order> product = transition * adjugate;
    p->a[k] = -product.trace() / static_cast<double>(k + 1);
    adjugate = product;
    adjugate.diagonal().array() += p->a[k];
  }
}

}  // namespace

void discretise(const VectorXd& numerator, const VectorXd& denominator, double dead_samples,
                int extra, Polynomials* p) {
  const auto of = [&](auto order) {
    discretiseOf<decltype(order)::value>(numerator, denominator, dead_samples, extra, p);
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

}  // namespace uncertainty_identification
