#pragma once

#include "curves/window_fit.h"

/// Which of two fits is better, where residuals are not independent.
namespace uncertainty_identification {

/// Number of independent samples among the residuals, by their autocorrelation.
double effectiveSamples(const WindowFit& fit);

/// BIC with the effective number of samples, which is that of the model that others are compared
/// to.
double criterion(const WindowFit& fit, double effective_samples);

/// Student's t of the paired differences of the windows' squared errors, or of their logarithms if
/// larger.
double pairedT(const Eigen::VectorXd& before, const Eigen::VectorXd& after);

}  // namespace uncertainty_identification
