#pragma once

#include <Eigen/Core>

#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// A and B of numerator/denominator behind a zero-order hold and a dead time, which need not be a
/// whole number of samples; exact. Polynomials in s with ascending powers and the sample time as
/// unit of time; the denominator's degree n is that of A. B has n + `extra` coefficients: a dead
/// time may be up to extra - 1 samples.
void discretise(const Eigen::VectorXd& numerator, const Eigen::VectorXd& denominator,
                double dead_samples, int extra, Polynomials* p);

}  // namespace uncertainty_identification
