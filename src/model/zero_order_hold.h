#pragma once

#include <Eigen/Core>
#include <unsupported/Eigen/AutoDiff>

namespace uncertainty_identification {

/// A value with its derivatives by four parameters.
using Dual = Eigen::AutoDiffScalar<Eigen::Vector4d>;

/// Coefficients of a polynomial.
template <typename Scalar>
using Coefficients = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

/// B and A of a sampled transfer function; the leading 1 of A is left out.
template <typename Scalar>
struct Sampled {
  Coefficients<Scalar> b, a;
};

/// A and B of numerator/denominator behind a zero-order hold and a dead time, which need not be a
/// whole number of samples; exact. Polynomials in s with ascending powers and the sample time as
/// unit of time; the denominator's degree n is that of A. B has n + `extra` coefficients: a dead
/// time may be up to extra - 1 samples. Scalar is double, or Dual for the derivatives; at a dead
/// time of a whole number of samples these are those of longer ones.
template <typename Scalar>
Sampled<Scalar> discretise(const Coefficients<Scalar>& numerator,
                           const Coefficients<Scalar>& denominator, const Scalar& dead_samples,
                           int extra);

extern template Sampled<double> discretise(const Coefficients<double>&, const Coefficients<double>&,
                                           const double&, int);
extern template Sampled<Dual> discretise(const Coefficients<Dual>&, const Coefficients<Dual>&,
                                         const Dual&, int);

}  // namespace uncertainty_identification
