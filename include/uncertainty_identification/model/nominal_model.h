#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

/// The four polynomials of a linear model, y = q^-delay B/A u + C/D omega, equations (6)-(11).
struct Polynomials {
  int delay = 1;            ///< [samples]
  Eigen::VectorXd b;        ///< B = b1 + b2 q^-1 + ... (behind the delay)
  Eigen::VectorXd a, c, d;  ///< monic, without the leading 1

  /// [b; a; c; d].
  Eigen::VectorXd stacked() const;
};

/// A parametrised linear model: parameters theta in, polynomials and their Jacobian out. Derive
/// from this to identify a model of your own (docs/adding_a_nominal_model.md;
/// examples/motor_model.cpp).
class NominalModel {
 public:
  virtual ~NominalModel() = default;

  /// Name written to results, e.g. "box_jenkins".
  virtual std::string structure() const = 0;

  /// Names of theta's entries; their number is the number of parameters.
  virtual std::vector<std::string> names() const = 0;

  /// Units of theta's entries; empty where they follow from the units of u and y.
  virtual std::vector<std::string> units() const;

  /// The polynomials at theta. Their sizes and the delay must not depend on theta.
  virtual Polynomials polynomials(const Eigen::VectorXd& theta) const = 0;

  /// d[b; a; c; d]/dtheta, (nb + na + nc + nd) x p. Default: central differences.
  virtual Eigen::MatrixXd jacobian(const Eigen::VectorXd& theta) const;

  /// Unbounded coordinates of theta in which an unconstrained optimisation stays admissible (stable
  /// A and D, minimum-phase C, positive time constants, ...), and back. Default: theta itself.
  virtual Eigen::VectorXd toUnbounded(const Eigen::VectorXd& theta) const { return theta; }
  virtual Eigen::VectorXd fromUnbounded(const Eigen::VectorXd& unbounded) const {
    return unbounded;
  }

  /// dtheta/d(unbounded), p x p. Default: central differences of fromUnbounded().
  virtual Eigen::MatrixXd unboundedJacobian(const Eigen::VectorXd& unbounded) const;

  /// Whether A, C and D have their roots inside the unit circle at theta (and theta is finite).
  virtual bool admissible(const Eigen::VectorXd& theta) const;

  /// Parameters that reproduce given polynomials of this model's sizes as nearly as possible: a
  /// start for the optimisation. Throws ConfigurationError where the model cannot be started from
  /// polynomials (then `initial: theta` is needed).
  virtual Eigen::VectorXd fromPolynomials(const Polynomials& polynomials) const;

  int parameterCount() const { return static_cast<int>(names().size()); }
};

/// The model that the options name; sample_time [s] is used by the continuous structure.
std::shared_ptr<const NominalModel> makeNominalModel(const NominalModelOptions& options,
                                                     double sample_time);

}  // namespace uncertainty_identification
