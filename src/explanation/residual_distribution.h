#pragma once

#include <algorithm>
#include <optional>

#include "explanation/fit.h"

namespace uncertainty_identification {

/// Fits of residual distributions that have heavier tails than a Gaussian. Gains are in
/// log-likelihood over a Gaussian [nats].
struct ResidualDistribution {
  /// Student's t distribution.
  double degrees = 0, student_gain = 0;
  /// Mixture of two Gaussians: share of the wide one, and its standard deviation over the narrow
  /// one's.
  double share = 0, ratio = 1, mixture_gain = 0;
  /// Additive outliers: wrong readings, each of which changes the residuals after it as well, by
  /// the impulse response D/C of the whitening. `found` is 1 at their samples, one signal per
  /// block; empty where the noise is white, as an outlier then changes one residual only.
  std::vector<Signals> found;
  double additive_gain = 0;  ///< of removing them, minus the cost of stating where and how large
  /// p-value of large residuals lying so close together in time.
  double clustering = 1;
  /// p-value of large residuals lying so often behind changes of the input.
  double after_changes = 1;
  /// p-value of residuals being the larger, the more the known signals have changed just before.
  double by_changes = 1;

  /// Whether they lie as noise does: neither in bursts nor behind changes of the input.
  bool isOfNoise() const {
    return clustering >= 1e-6 && after_changes >= 1e-3 && by_changes >= 1e-4;
  }

  /// Whether the residuals are better explained by wrong readings than by disturbances.
  bool areAdditive() const;
  /// Whether large residuals may be wrong readings. Where the noise is coloured, the data tell
  /// these from disturbances such as shocks and load steps, whose effect on the output lasts.
  bool mayBeReadings() const { return found.empty() || areAdditive(); }
  /// Gain of taking them for wrong readings; 0 where they are none.
  double readingsGain() const {
    return mayBeReadings() ? std::max(mixture_gain, additive_gain) : 0;
  }
};

ResidualDistribution residualDistribution(const Fit& fit, const FitData& data,
                                          const Residuals& residuals);

enum class DistributionFamily { student, mixture };

/// Whether an effect is a residual distribution (noise_tails or sens_outliers), and which.
bool isResidualDistribution(const Effect& effect);
DistributionFamily familyOf(const Effect& effect);

/// Gain of log density [nats] of each experiment by a distribution of the given family over a
/// Gaussian one.
Eigen::VectorXd distributionGain(const ResidualDistribution& distribution,
                                 DistributionFamily family, const Residuals& residuals,
                                 const FitData& data);

/// The experiments with their outliers masked: the additive outliers if these explain the data
/// about as well as a mixture does, otherwise all samples whose residual is large.
std::vector<Experiment> withoutOutliers(const FitData& data, const Residuals& residuals,
                                        const ResidualDistribution& distribution);

}  // namespace uncertainty_identification
