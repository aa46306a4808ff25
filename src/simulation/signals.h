#pragma once

#include <Eigen/Core>

/// Operations on whole signals that the simulators share.
namespace uncertainty_identification {

/// q^-delay numerator/denominator of a signal, from rest; the denominator without its leading 1.
Eigen::VectorXd filtered(const Eigen::VectorXd& numerator, const Eigen::VectorXd& denominator,
                         int delay, const Eigen::VectorXd& signal);

/// (1 - pole)/(1 - pole q^-1) of a signal, from rest.
Eigen::VectorXd lagged(double pole, const Eigen::VectorXd& signal);

/// The signal at k - delay [samples], delay 0 or above, linear between samples, 0 before the first.
Eigen::VectorXd delayed(const Eigen::VectorXd& signal, double delay);

/// The signal at the instants k + shift(k) [samples] by cubic interpolation between four samples; 0
/// before the first one, the last one for ever after.
Eigen::VectorXd resampledAt(const Eigen::VectorXd& signal, const Eigen::VectorXd& shift);

/// step round(signal/step).
Eigen::VectorXd quantised(double step, const Eigen::VectorXd& signal);

/// How much of an event that begins at `start` [samples], perhaps between two, is there at sample
/// k: 0 to 1.
double onset(int k, double start);

}  // namespace uncertainty_identification
