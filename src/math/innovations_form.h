#pragma once

#include <Eigen/Core>

namespace uncertainty_identification {

/// `from` with zeros behind it, up to `size` entries.
Eigen::VectorXd padded(const Eigen::VectorXd& from, Eigen::Index size);

/// Solution P of the discrete Lyapunov equation P = F P F' + Q by doubling: after k steps P holds
/// 2^k terms of the sum of F^j Q F'^j. F must be stable.
Eigen::MatrixXd solveLyapunov(Eigen::MatrixXd F, Eigen::MatrixXd Q);

/// Transition matrix F = [-d | shift] of H = C/D in observer form, where D = 1 + d1 q^-1 + ...
Eigen::MatrixXd observerTransition(const Eigen::VectorXd& d);

/// H = C/D in innovations form, with unit variance of the innovations w:
///     s' = F s + K w,   v = s_1 + w,   F = [-d | shift],   K = c - d,
/// and the Riccati recursion of the Kalman filter that follows it from a start that is not known
/// exactly. Where P has come to zero the start is forgotten and the gain is K.
struct InnovationsForm {
  /// `c` and `d` of the same length, without their leading 1; P = 0.
  InnovationsForm(const Eigen::VectorXd& c, const Eigen::VectorXd& d);

  /// Covariance of s where the noise has been running for long.
  Eigen::MatrixXd stationaryCovariance() const;

  /// One sample on: S and the gain of this sample, then the P of the next. Where v is not
  /// measured, P is only predicted.
  void step(bool measured);

  Eigen::MatrixXd F;
  Eigen::VectorXd K;
  Eigen::MatrixXd P;     ///< covariance of the error of s
  double S = 1;          ///< variance of the prediction error of v
  Eigen::VectorXd gain;  ///< Kalman gain
};

}  // namespace uncertainty_identification
