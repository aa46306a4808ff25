#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/model/block.h"

namespace uncertainty_identification {

/// The basis filters F_1..F_L of the relative error model GDelta = sum_k eta_k F_k and its
/// constraint eta = T xi, equation (12):
///   fir:       F_k = q^-(k-1)
///   laguerre:  F_k = sqrt(1 - p^2)/(1 - p q^-1) ((q^-1 - p)/(1 - p q^-1))^(k-1)
///   kautz:     two-parameter Kautz functions of the pole pair (pole_real, +-pole_imag)
/// All have a direct term, so that a pole at 0 gives the FIR basis.
class ErrorBasis {
 public:
  /// Throws ConfigurationError for a pole outside the unit circle or a T of wrong size.
  explicit ErrorBasis(const ErrorModelOptions& options);

  int taps() const { return taps_; }

  /// Number n of free error parameters xi.
  int dimension() const { return static_cast<int>(T_.cols()); }

  /// taps x n. For zero_static_gain its columns span the eta with sum_k eta_k F_k(1) = 0.
  const Eigen::MatrixXd& T() const { return T_; }

  BasisKind kind() const { return options_.basis; }

  /// The options given to the constructor.
  const ErrorModelOptions& options() const { return options_; }

  /// Static gains F_k(1) (taps).
  Eigen::VectorXd staticGains() const;

  /// Responses F_k(z) of all basis filters (taps entries) at z = 1/z_inverse.
  Eigen::VectorXcd responses(std::complex<double> z_inverse) const;

  /// Common denominator of the basis filters, monic and without the leading 1 (empty for FIR).
  Eigen::VectorXd denominator() const;

  /// The regressors of the error model before noise whitening: sum_k T_ki F_k x for i = 1..n.
  void apply(const Signals& x, std::vector<Signals>* out) const;

  /// The outputs F_k x of the basis filters (taps signals).
  std::vector<Signals> filtered(const Signals& x) const;

 private:
  ErrorModelOptions options_;
  int taps_;
  Eigen::MatrixXd T_;
};

}  // namespace uncertainty_identification
