#pragma once

#include <Eigen/Core>

/// Operations on whole signals that several stages of the simulation use.
namespace uncertainty_identification {

/// The signal filtered by q^-delay numerator/denominator, starting at rest. The denominator is
/// given without its leading 1.
Eigen::VectorXd filtered(const Eigen::VectorXd& numerator, const Eigen::VectorXd& denominator,
                         int delay, const Eigen::VectorXd& signal);

/// The signal filtered by (1 - pole)/(1 - pole q^-1), starting at rest.
Eigen::VectorXd lagged(double pole, const Eigen::VectorXd& signal);

/// The signal delayed by `delay` samples, 0 or above, with linear interpolation. Before its first
/// sample the signal is 0.
Eigen::VectorXd delayed(const Eigen::VectorXd& signal, double delay);

/// The signal at the times k + shift(k) [samples], by cubic interpolation between four samples. The
/// signal is 0 before its first sample and keeps its last value after the end.
Eigen::VectorXd resampledAt(const Eigen::VectorXd& signal, const Eigen::VectorXd& shift);

/// The signal rounded to multiples of `step`.
Eigen::VectorXd quantised(double step, const Eigen::VectorXd& signal);

/// The share of a change at time `start` [samples] that sample k shows: 0 before it, 1 after it,
/// and k + 1 - start at the last sample before a start that lies between two samples.
double onset(int k, double start);

}  // namespace uncertainty_identification
