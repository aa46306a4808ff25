#pragma once

#include "explanation/fit.h"
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

/// Paired differences of the log densities of experiments [nats]: what one model gains over
/// another.
struct PairedGains {
  Eigen::VectorXd held;      ///< of those held out
  Eigen::VectorXd training;  ///< of those fitted to; empty where they are the same
};

/// The mean over the experiments held out. How gains spread is seen in those fitted to as well: a
/// rare kind of experiment that the few held out lack must count. One of each kind: NaN.
struct MeanGain {
  double value = 0, standard_error = 0;
  double lower_90 = 0, upper_90 = 0;  ///< by Student's t
};

MeanGain meanGain(const PairedGains& gains);

/// What `after` gains over `before`, `gains` by log density.
Gain gainOf(const HeldOut& before, const HeldOut& after, const PairedGains& gains);

/// Experiments as two models see them: the median and the worst fit of the first.
std::vector<ExperimentPicture> picturesOf(const Fit& before, const Fit& after, const FitData& data);

}  // namespace uncertainty_identification
