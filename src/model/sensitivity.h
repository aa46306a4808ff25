#pragma once

#include <Eigen/Core>
#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// Whether the error model varies Go's parameters rather than adding filters:
/// BasisKind::sensitivity or parameter_spread.
bool variesParameters(BasisKind basis);

/// The regressors of an error model that varies parameters of Go (docs/method.md, section on
/// parameters that vary), one per multiset of the varied parameters:
///   R_j = theta_j dGo/dtheta_j u,
/// and, of order 2, R_jk = theta_j theta_k d2Go/dtheta_j dtheta_k u, halved where j = k.
/// Second derivatives that vanish everywhere (Go is linear in its gain, or in b) are left out.
struct SensitivityTerms {
  std::vector<std::vector<int>> indices;  ///< of theta, sorted; one list per regressor

  int count() const { return static_cast<int>(indices.size()); }

  /// Factor of the derivative in regressor i: the parameters' product, halved for a square.
  double scale(int i, const Eigen::VectorXd& theta) const;

  /// Its derivative to theta_l.
  double scaleDerivative(int i, int l, const Eigen::VectorXd& theta) const;
};

/// The terms that options (with `parameters` given) name. Throws ConfigurationError for a name that
/// is none of the model's, or of a parameter that does not move Go.
SensitivityTerms sensitivityTerms(const NominalModel& nominal, const ErrorModelOptions& options);

/// Fills what the options leave open where the basis varies parameters: their names (default: all
/// that move Go; parameter_spread: only where there is one) and the number of taps, which is that
/// of the latent parameters. Throws ConfigurationError, also where there are more than 10 of them.
void completeErrorModel(const NominalModel& nominal, ErrorModelOptions* options);

/// Frequency responses of the terms' regressors, omega.size() x count(): G = Go + sum_i xi_i R_i.
/// `omega` in [rad/sample].
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
