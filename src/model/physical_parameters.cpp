#include "model/physical_parameters.h"

#include <algorithm>

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The product of p, a polynomial in s with ascending powers, and 1 + f1 s + f2 s^2.
template <typename Scalar>
Coefficients<Scalar> times(const Coefficients<Scalar>& p, const Scalar& f1, const Scalar& f2,
                           Eigen::Index degree) {
  Coefficients<Scalar> out = Coefficients<Scalar>::Zero(p.size() + degree);
  out.head(p.size()) = p;
  out.segment(1, p.size()) += p * f1;
  if (degree == 2) out.segment(2, p.size()) += p * f2;
  return out;
}

/// B and A at the values of all parameters.
template <typename Scalar>
Sampled<Scalar> sample(const std::vector<PhysicalParameter>& physical,
                       const std::vector<Scalar>& value, double sample_time, int extra) {
  Coefficients<Scalar> numerator = Coefficients<Scalar>::Ones(1), denominator = numerator;
  Scalar dead_samples(0);
  const Scalar rate(1 / sample_time), one(1);
  for (std::size_t k = 0; k < physical.size(); ++k) {
    const Scalar scaled = value[k] * rate;
    switch (physical[k].kind) {
      case PhysicalParameter::gain:
        numerator *= value[k];
        break;
      case PhysicalParameter::time_constant:
        denominator = times<Scalar>(denominator, scaled, Scalar(0), 1);
        break;
      case PhysicalParameter::frequency: {
        const Scalar period = one / (value[k] * Scalar(sample_time));
        const Scalar slope = Scalar(2) * value[k + 1] * period, square = period * period;
        denominator = times<Scalar>(denominator, slope, square, 2);
        break;
      }
      case PhysicalParameter::zero:
        numerator = times<Scalar>(numerator, scaled, Scalar(0), 1);
        break;
      case PhysicalParameter::dead_time:
        dead_samples = scaled;
        break;
      case PhysicalParameter::damping:
        break;
    }
  }
  return discretise<Scalar>(numerator, denominator, dead_samples, extra);
}

/// The values of all parameters, with the derivatives by those of theta from `first` on.
std::vector<Dual> dualValues(const std::vector<PhysicalParameter>& physical, const VectorXd& theta,
                             Index first) {
  std::vector<Dual> all;
  all.reserve(physical.size());
  Index next = 0;
  for (const PhysicalParameter& p : physical) {
    all.emplace_back(p.fixed ? p.value : theta[next]);
    if (p.fixed) continue;
    const Index k = next++ - first;
    if (k >= 0 && k < Dual::DerType::SizeAtCompileTime) all.back().derivatives()[k] = 1;
  }
  return all;
}

}  // namespace

std::vector<double> valuesOf(const std::vector<PhysicalParameter>& physical,
                             const VectorXd& theta) {
  std::vector<double> all;
  all.reserve(physical.size());
  Index next = 0;
  for (const PhysicalParameter& p : physical) all.push_back(p.fixed ? p.value : theta[next++]);
  return all;
}

Sampled<double> sampledPlant(const std::vector<PhysicalParameter>& physical, const VectorXd& theta,
                             double sample_time, int extra) {
  return sample(physical, valuesOf(physical, theta), sample_time, extra);
}

MatrixXd sampledJacobian(const std::vector<PhysicalParameter>& physical, const VectorXd& theta,
                         double sample_time, int extra) {
  constexpr Index kAtOnce = Dual::DerType::SizeAtCompileTime;
  MatrixXd jacobian;
  for (Index first = 0; first == 0 || first < theta.size(); first += kAtOnce) {
    const Index count = std::min(kAtOnce, theta.size() - first);
    const Sampled<Dual> sampled =
        sample(physical, dualValues(physical, theta, first), sample_time, extra);
    const Index nb = sampled.b.size(), rows = nb + sampled.a.size();
    if (first == 0) jacobian.resize(rows, theta.size());
    for (Index k = 0; k < rows; ++k) {
      const Dual& coefficient = k < nb ? sampled.b[k] : sampled.a[k - nb];
      jacobian.row(k).segment(first, count) = coefficient.derivatives().head(count).transpose();
    }
  }
  return jacobian;
}

}  // namespace uncertainty_identification
