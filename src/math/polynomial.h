#pragma once

#include <Eigen/Core>
#include <complex>

namespace uncertainty_identification {

/// Monic polynomials in q^-1 are stored without their leading 1: p = [p1..pn] is 1 + p1 q^-1 + ...
/// + pn q^-n.

/// Reflection coefficients k1..kn of a monic polynomial (Levinson's step-down recursion); its roots
/// lie inside the unit circle exactly when all are below 1 in magnitude. Entries are NaN when the
/// recursion breaks down.
Eigen::VectorXd reflectionCoefficients(const Eigen::VectorXd& monic);

/// The monic polynomial with given reflection coefficients (step-up recursion), and, when asked
/// for, its Jacobian d(polynomial)/d(reflection), n x n.
Eigen::VectorXd fromReflection(const Eigen::VectorXd& reflection,
                               Eigen::MatrixXd* jacobian = nullptr);

/// Whether all roots of the monic polynomial lie inside the circle of `radius`.
bool isStable(const Eigen::VectorXd& monic, double radius = 1.0);

/// Reflects roots outside `radius` to the inside, so that 1/p is stable.
Eigen::VectorXd stabilised(const Eigen::VectorXd& monic, double radius = 0.999);

/// Roots in the q plane (n complex numbers), by the eigenvalues of the companion matrix.
Eigen::VectorXcd roots(const Eigen::VectorXd& monic);

/// [1; monic]: all coefficients.
Eigen::VectorXd withLeadingOne(const Eigen::VectorXd& monic);

/// Product of two polynomials given by all their coefficients.
Eigen::VectorXd product(const Eigen::VectorXd& left, const Eigen::VectorXd& right);

/// p0 + p1 z^-1 + ... of a polynomial given by all its coefficients.
std::complex<double> valueAt(const Eigen::VectorXd& polynomial, std::complex<double> z_inverse);

/// Product of two monic polynomials.
Eigen::VectorXd multiply(const Eigen::VectorXd& left, const Eigen::VectorXd& right);

/// Unbounded coordinates of a stable monic polynomial: atanh of its reflection coefficients. Throws
/// std::domain_error when it is not stable.
Eigen::VectorXd toUnbounded(const Eigen::VectorXd& monic);

/// Inverse of toUnbounded(): any vector gives a stable polynomial; Jacobian
/// d(polynomial)/d(unbounded) when asked for.
Eigen::VectorXd fromUnbounded(const Eigen::VectorXd& unbounded,
                              Eigen::MatrixXd* jacobian = nullptr);

}  // namespace uncertainty_identification
