#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/model/block.h"

namespace uncertainty_identification {

/// The basis filters F_1..F_L of the relative error model and its constraint eta = T xi, equation
/// (12).
///   fir:       F_k = q^-(k-1)
///   laguerre:  F_k = sqrt(1 - p^2)/(1 - p q^-1) ((q^-1 - p)/(1 - p q^-1))^(k-1)
///   kautz:     two-parameter Kautz functions of the pole pair (pole_real, +-pole_imag)
/// each with a direct term, so that a pole at 0 gives the FIR basis back.
class ErrorBasis {
 public:
  /// Throws ConfigurationError for a pole outside the unit circle or a T of the wrong size.
  explicit ErrorBasis(const ErrorModelOptions& options);

  int taps() const { return taps_; }

  /// Number n of free error parameters xi.
  int dimension() const { return static_cast<int>(T_.cols()); }

  /// taps x n; zero_static_gain spans the eta with sum_k eta_k F_k(1) = 0.
  const Eigen::MatrixXd& T() const { return T_; }

  BasisKind kind() const { return options_.basis; }

  /// What it was made from.
  const ErrorModelOptions& options() const { return options_; }

  /// Static gains F_k(1) (taps).
  Eigen::VectorXd staticGains() const;

  /// F_k(z) of all basis filters (taps) at z given by its inverse.
  Eigen::VectorXcd responses(std::complex<double> z_inverse) const;

  /// Monic denominator common to all basis filters, without the leading 1 (empty for FIR).
  Eigen::VectorXd denominator() const;

  /// sum_k T_ki F_k x for i = 1..n: the error model's regressors before noise whitening.
  void apply(const Signals& x, std::vector<Signals>* out) const;

  /// The basis filters' outputs F_k x (taps signals).
  std::vector<Signals> filtered(const Signals& x) const;

 private:
  ErrorModelOptions options_;
  int taps_;
  Eigen::MatrixXd T_;
};

}  // namespace uncertainty_identification
