#pragma once

#include <Eigen/Core>
#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// Whether the error model varies parameters of Go instead of adding filters in series:
/// BasisKind::sensitivity or parameter_spread.
bool variesParameters(BasisKind basis);

/// The regressors of an error model that varies parameters theta of Go (docs/method.md, section on
/// parameters that vary), one for each combination of one or two of the varied parameters:
///   R_j = theta_j dGo/dtheta_j u,
/// and, with order 2, R_jk = theta_j theta_k d2Go/dtheta_j dtheta_k u, halved if j = k.
/// Second derivatives that are identically zero (Go is linear in its gain and in b) are left out.
struct SensitivityTerms {
  std::vector<std::vector<int>> indices;  ///< indices of theta, sorted; one list per regressor

  int count() const { return static_cast<int>(indices.size()); }

  /// The factor of the derivative in regressor i: the product of the parameters, halved for a
  /// square.
  double scale(int i, const Eigen::VectorXd& theta) const;

  /// Derivative of scale() with respect to theta_l.
  double scaleDerivative(int i, int l, const Eigen::VectorXd& theta) const;
};

/// The terms for `options`, whose `parameters` must be filled. Throws ConfigurationError for a name
/// that the model does not have, or of a parameter that Go does not depend on.
SensitivityTerms sensitivityTerms(const NominalModel& nominal, const ErrorModelOptions& options);

/// If the basis varies parameters, fills in what the options leave open: the names (default: all
/// parameters of Go; with parameter_spread only if there is just one) and the number of taps, which
/// equals the number of terms. Throws ConfigurationError also if there are more than 10.
void completeErrorModel(const NominalModel& nominal, ErrorModelOptions* options);

/// Frequency responses R_i of the terms at `omega` [rad/sample], omega.size() x count(): G = Go +
/// sum_i xi_i R_i.
Eigen::MatrixXcd sensitivityResponses(const NominalModel& nominal, const SensitivityTerms& terms,
                                      const Eigen::VectorXd& theta, const Eigen::VectorXd& omega);

/// G = q^-delay (nominal + sum_i xi_i terms_i)/denominator as polynomials in q^-1.
struct SensitivityNumerators {
  int delay = 0;
  Eigen::VectorXd nominal;      ///< B A^order
  Eigen::MatrixXd terms;        ///< one column per regressor
  Eigen::VectorXd denominator;  ///< A^(order + 1), monic, without the leading 1
};
SensitivityNumerators sensitivityNumerators(const NominalModel& nominal,
                                            const SensitivityTerms& terms, int order,
                                            const Eigen::VectorXd& theta);

}  // namespace uncertainty_identification
