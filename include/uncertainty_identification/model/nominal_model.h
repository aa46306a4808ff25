#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

/// The four polynomials of a linear model y = q^-delay B/A u + C/D omega, equations (6)-(11).
struct Polynomials {
  int delay = 1;            ///< [samples]
  Eigen::VectorXd b;        ///< B = b1 + b2 q^-1 + ...; the delay is not part of it
  Eigen::VectorXd a, c, d;  ///< monic, without the leading 1

  /// [b; a; c; d].
  Eigen::VectorXd stacked() const;
};

/// A linear model with parameters theta: maps theta to polynomials and their Jacobian. Derive from
/// this class to identify a model of your own (docs/adding_a_nominal_model.md;
/// examples/motor_model.cpp).
class NominalModel {
 public:
  virtual ~NominalModel() = default;

  /// Name written to results, e.g. "box_jenkins".
  virtual std::string structure() const = 0;

  /// Names of the entries of theta; their number is the number of parameters.
  virtual std::vector<std::string> names() const = 0;

  /// Units of the entries of theta; empty texts where they follow from the units of u and y.
  virtual std::vector<std::string> units() const;

  /// The polynomials at theta. Their sizes and the delay must not depend on theta.
  virtual Polynomials polynomials(const Eigen::VectorXd& theta) const = 0;

  /// d[b; a; c; d]/dtheta, (nb + na + nc + nd) x p. Default: central differences.
  virtual Eigen::MatrixXd jacobian(const Eigen::VectorXd& theta) const;

  /// Maps theta to unbounded coordinates, and back. Every value of these coordinates must give an
  /// admissible theta (stable A and D, minimum-phase C, positive time constants, ...), so that an
  /// unconstrained optimisation can use them. Default: theta itself.
  virtual Eigen::VectorXd toUnbounded(const Eigen::VectorXd& theta) const { return theta; }
  virtual Eigen::VectorXd fromUnbounded(const Eigen::VectorXd& unbounded) const {
    return unbounded;
  }

  /// dtheta/d(unbounded), p x p. Default: central differences of fromUnbounded().
  virtual Eigen::MatrixXd unboundedJacobian(const Eigen::VectorXd& unbounded) const;

  /// Whether theta is finite and the roots of A, C and D lie inside the unit circle.
  virtual bool admissible(const Eigen::VectorXd& theta) const;

  /// Parameters whose polynomials are as close as possible to given ones of the same sizes: a start
  /// for the optimisation. Throws ConfigurationError if the model cannot derive a start from
  /// polynomials (then `initial: theta` must be given).
  virtual Eigen::VectorXd fromPolynomials(const Polynomials& polynomials) const;

  int parameterCount() const { return static_cast<int>(names().size()); }
};

/// Creates the model that the options describe. Only the continuous structure uses sample_time [s].
std::shared_ptr<const NominalModel> makeNominalModel(const NominalModelOptions& options,
                                                     double sample_time);

}  // namespace uncertainty_identification
