#pragma once

#include <Eigen/Core>

namespace uncertainty_identification {

/// `from` with zeros appended up to length `size`.
Eigen::VectorXd padded(const Eigen::VectorXd& from, Eigen::Index size);

/// Solution P of the discrete Lyapunov equation P = F P F' + Q by doubling: after k steps P is the
/// sum of the first 2^k terms F^j Q F'^j. F must be stable.
Eigen::MatrixXd solveLyapunov(Eigen::MatrixXd F, Eigen::MatrixXd Q);

/// Transition matrix F = [-d | shift] of H = C/D in observer form, D = 1 + d1 q^-1 + ...
Eigen::MatrixXd observerTransition(const Eigen::VectorXd& d);

/// The noise model H = C/D in innovations form with innovations w of unit variance,
///     s' = F s + K w,   v = s_1 + w,   F = [-d | shift],   K = c - d,
/// and the Riccati recursion of its Kalman filter when the initial state is uncertain. P tends to
/// zero as the initial state is forgotten; then the gain is K. `Order` is fixed where the recursion
/// is repeated so often that its speed matters.
template <int Order>
struct InnovationsFormOf {
  using Vector = Eigen::Matrix<double, Order, 1>;
  using Matrix = Eigen::Matrix<double, Order, Order>;

  /// `c` and `d` have the same length and no leading 1. Starts with P = 0.
  InnovationsFormOf(const Eigen::VectorXd& c, const Eigen::VectorXd& d)
      : F(observerTransition(d)),
        K(c - d),
        P(Eigen::MatrixXd::Zero(d.size(), d.size())),
        gain(Eigen::VectorXd::Zero(d.size())) {}

  /// One step of the recursion: computes S and the gain of this sample, then P of the next one. If
  /// v is not measured at this sample, P is only predicted.
  void step(bool measured) {
    S = P(0, 0) + 1;
    gain = (F * P.col(0) + K) / S;
    P = (F * P * F.transpose() + K * K.transpose()).eval();
    if (measured) P -= S * gain * gain.transpose();
  }

  Matrix F;
  Vector K;
  Matrix P;      ///< covariance of the error of s
  double S = 1;  ///< variance of the one-step prediction error of v
  Vector gain;   ///< Kalman gain
};

/// The innovations form of any order.
struct InnovationsForm : InnovationsFormOf<Eigen::Dynamic> {
  using InnovationsFormOf::InnovationsFormOf;

  /// Covariance of s in the stationary state, when the noise has been running for a long time.
  Eigen::MatrixXd stationaryCovariance() const;
};

}  // namespace uncertainty_identification
