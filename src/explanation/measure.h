#pragma once

#include "explanation/fit.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// How well a fit predicts experiments that it was not fitted to.
struct HeldOut {
  Eigen::VectorXd log_density;  ///< [nats] of each experiment
  double nrmse_fit_percent = 0;
  double coverage_50 = 0, coverage_90 = 0, coverage_95 = 0;  ///< shares of samples in the intervals
  double noise_variance = 0;
  double bode_area = 0;  ///< as of bodeArea()
};

/// Log predictive density of each experiment [nats]; -1e300 where it cannot be computed.
Eigen::VectorXd logDensities(const Fit& fit, const FitData& data);

/// The fit is about the mean of all outputs, also where each experiment has an offset of its own.
HeldOut heldOut(const Fit& fit, const FitData& data);

/// Root of the sum of squares of all outputs about their common mean, over that about each
/// experiment's own: a fit f [%] about the former is 100 - (100 - f) spreadOfLevels() about the
/// latter.
double spreadOfLevels(const std::vector<Experiment>& experiments);

/// Gains of one model over another: differences of the log densities of each experiment [nats].
struct PairedGains {
  Eigen::VectorXd held;      ///< of the held-out experiments
  Eigen::VectorXd training;  ///< of those fitted to; empty where none are held out
};

/// The mean gain over the held-out experiments with its standard error. The variance of the gains
/// is pooled over the held-out experiments and those fitted to, as the few held-out ones may lack a
/// rare kind of experiment. Standard error and limits are NaN where both have a single experiment.
struct MeanGain {
  double value = 0, standard_error = 0;
  double lower_90 = 0, upper_90 = 0;  ///< by Student's t
};

MeanGain meanGain(const PairedGains& gains);

/// The gain of `after` over `before` in all measures; that in log density is the mean of `gains`.
Gain gainOf(const HeldOut& before, const HeldOut& after, const PairedGains& gains);

/// Measured and simulated signals of two experiments under two models: those that the first model
/// fits worst and of median quality.
std::vector<ExperimentPicture> picturesOf(const Fit& before, const Fit& after, const FitData& data);

}  // namespace uncertainty_identification
