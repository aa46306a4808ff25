#pragma once

#include <utility>

#include "fit.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// How well a fit predicts experiments that it was not fitted to.
struct HeldOut {
  Eigen::VectorXd log_density;  ///< [nats] of each experiment
  double nrmse_fit_percent = 0;
  double coverage_50 = 0, coverage_90 = 0, coverage_95 = 0;
  double noise_variance = 0;
  double bode_area = 0;  ///< as of bodeArea()
};

/// [nats] of each experiment; -1e300 where the fit has none.
Eigen::VectorXd logDensities(const Fit& fit, const FitData& data);

HeldOut heldOut(const Fit& fit, const FitData& data);

/// The mean of paired differences and its standard error; of one difference NaN.
std::pair<double, double> meanWithError(const Eigen::VectorXd& values);

/// Paired: what `after` gains over `before`. `added` [nats] for each experiment is what a law of
/// the residuals adds that the likelihood does not hold.
Gain gainOf(const HeldOut& before, const HeldOut& after, const Eigen::VectorXd& added);

/// Experiments as two models see them: the median and the worst fit of the first.
std::vector<ExperimentPicture> picturesOf(const Fit& before, const Fit& after, const FitData& data);

}  // namespace uncertainty_identification
