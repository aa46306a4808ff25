#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "uncertainty_identification/model/nominal_model.h"

/// A direct-current motor from voltage [V] to speed [rad/s]. Its parameters are those that the data
/// sheet does not state:
///   J d(speed)/dt = k current - friction speed,   voltage = R current + k speed,
/// which is a first-order system of gain k/(k^2 + R friction) and time constant J R/(k^2 + R
/// friction), under the zero-order hold of a digital amplifier. The speed sensor adds white noise
/// (C = D = 1).
class MotorModel : public uncertainty_identification::NominalModel {
 public:
  using Polynomials = uncertainty_identification::Polynomials;

  static constexpr double kResistance = 1.0;       ///< R [ohm], from the data sheet
  static constexpr double kTorqueConstant = 0.05;  ///< k [N m/A], from the data sheet

  explicit MotorModel(double sample_time) : sample_time_(sample_time) {}

  std::string structure() const override { return "motor"; }
  std::vector<std::string> names() const override { return {"inertia", "friction"}; }
  std::vector<std::string> units() const override { return {"kg m^2", "N m s/rad"}; }

  /// Zero-order hold: speed_(t+1) = p speed_t + gain (1 - p) voltage_t.
  Polynomials polynomials(const Eigen::VectorXd& theta) const override {
    const double damping = kTorqueConstant * kTorqueConstant + kResistance * theta[1];
    const double p = std::exp(-sample_time_ * damping / (theta[0] * kResistance));
    Polynomials motor;
    motor.delay = 1;
    motor.b = Eigen::VectorXd::Constant(1, kTorqueConstant / damping * (1 - p));
    motor.a = Eigen::VectorXd::Constant(1, -p);
    return motor;
  }

  /// Both parameters are positive: optimise over their logarithms.
  Eigen::VectorXd toUnbounded(const Eigen::VectorXd& theta) const override {
    return theta.array().log();
  }
  Eigen::VectorXd fromUnbounded(const Eigen::VectorXd& unbounded) const override {
    return unbounded.array().exp();
  }
  bool admissible(const Eigen::VectorXd& theta) const override {
    return (theta.array() > 0).all() && NominalModel::admissible(theta);
  }

  /// The motor that is closest to a fitted first-order system; if there is none, a motor with
  /// nearly no friction.
  Eigen::VectorXd fromPolynomials(const Polynomials& fitted) const override {
    const double p = std::min(std::max(-fitted.a[0], 0.01), 0.999);
    const double slowest = kTorqueConstant * kTorqueConstant;  // k^2 + R friction without friction
    const double damping = std::max(kTorqueConstant * (1 - p) / fitted.b[0], 1.01 * slowest);
    const double inertia = -sample_time_ * damping / (kResistance * std::log(p));
    return Eigen::Vector2d(inertia, (damping - slowest) / kResistance);
  }

 private:
  double sample_time_;  ///< [s]
};
