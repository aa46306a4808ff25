#pragma once

#include "curves/window_fit.h"

/// Which of two fits is better, where residuals are not independent.
namespace uncertainty_identification {

/// Number of independent samples among the residuals, by their autocorrelation.
double effectiveSamples(const WindowFit& fit);

/// By which the squared error of unseen windows is multiplied for the parameters of the fit.
double penaltyOf(const WindowFit& fit);

/// BIC with the effective number of samples, which is that of the model that others are compared
/// to.
double criterion(const WindowFit& fit, double effective_samples);

/// Student's t of the paired differences of the windows' squared errors, or of their logarithms if
/// larger.
double pairedT(const Eigen::VectorXd& before, const Eigen::VectorXd& after);

struct LeastGain {
  double share = 0;  ///< of the squared error
  double t = 0;      ///< of pairedT()
};

/// Whether windows that were not fitted to gain: significantly, or, where there are at most four
/// and these may be too few to show it, by half of their squared error. True where nothing is
/// given.
bool convinces(const Eigen::VectorXd& before, const Eigen::VectorXd& after, std::size_t windows,
               const LeastGain& least);

/// Whether each curve has a parameter that differs from zero by three standard errors.
bool isSignificant(const WindowFit& fit);

}  // namespace uncertainty_identification
