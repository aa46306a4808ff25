#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

namespace uncertainty_identification {

/// Monic polynomials in q^-1 are stored without their leading 1: p = [p1..pn] is 1 + p1 q^-1 + ...
/// + pn q^-n.

/// Reflection coefficients k1..kn of a monic polynomial (Levinson's step-down recursion). Its roots
/// lie inside the unit circle exactly if all coefficients are smaller than 1 in magnitude. Entries
/// are NaN if the recursion breaks down.
Eigen::VectorXd reflectionCoefficients(const Eigen::VectorXd& monic);

/// The monic polynomial with the given reflection coefficients (step-up recursion). Writes the
/// Jacobian d(polynomial)/d(reflection), n x n, unless the pointer is null.
Eigen::VectorXd fromReflection(const Eigen::VectorXd& reflection,
                               Eigen::MatrixXd* jacobian = nullptr);

/// Whether all roots of the monic polynomial lie inside the circle of `radius`.
bool isStable(const Eigen::VectorXd& monic, double radius = 1.0);

/// Whether the free response of a root decays to 5 % within `samples`, if it oscillates at all: if
/// the root is complex or negative.
bool oscillationDecays(std::complex<double> root, int samples);

/// Whether every oscillation of 1/p decays to 5 % within `samples`.
bool oscillationsDecay(const Eigen::VectorXd& monic, int samples);

/// Frequency [rad/sample] of an oscillation of 1/p of more than so many periods within `samples`
/// that loses or gains less than a tenth of its amplitude there; 0 if there is none.
double lastingFrequency(const Eigen::VectorXd& monic, double samples, double periods = 10);

/// Mirrors roots outside `radius` at the circle, so that 1/p is stable.
Eigen::VectorXd stabilised(const Eigen::VectorXd& monic, double radius = 0.999);

/// The n complex roots in the q plane, computed as eigenvalues of the companion matrix.
Eigen::VectorXcd roots(const Eigen::VectorXd& monic);

/// The same to loop over: vectors of Eigen 3.3 have no iterators.
std::vector<std::complex<double>> listOfRoots(const Eigen::VectorXd& monic);

/// All coefficients: [1; monic].
Eigen::VectorXd withLeadingOne(const Eigen::VectorXd& monic);

/// Product of two polynomials given by all their coefficients.
Eigen::VectorXd product(const Eigen::VectorXd& left, const Eigen::VectorXd& right);

/// Value of p0 + p1 z^-1 + ... at z_inverse. `polynomial` holds all coefficients.
std::complex<double> valueAt(const Eigen::VectorXd& polynomial, std::complex<double> z_inverse);

/// Product of two monic polynomials.
Eigen::VectorXd multiply(const Eigen::VectorXd& left, const Eigen::VectorXd& right);

/// The signal filtered by 1/p from rest, with p monic.
Eigen::VectorXd dividedBy(const Eigen::VectorXd& monic, const Eigen::VectorXd& signal);

/// Unbounded coordinates of a stable monic polynomial: atanh of its reflection coefficients. Throws
/// std::domain_error if it is not stable.
Eigen::VectorXd toUnbounded(const Eigen::VectorXd& monic);

/// Inverse of toUnbounded(): every vector gives a stable polynomial. Writes the Jacobian
/// d(polynomial)/d(unbounded), n x n, unless the pointer is null.
Eigen::VectorXd fromUnbounded(const Eigen::VectorXd& unbounded,
                              Eigen::MatrixXd* jacobian = nullptr);

}  // namespace uncertainty_identification
