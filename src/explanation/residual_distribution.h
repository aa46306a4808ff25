#pragma once

#include <optional>

#include "explanation/fit.h"

namespace uncertainty_identification {

/// Large residuals, and what they are.
struct ResidualDistribution {
  /// Student's t, its degrees of freedom and gain of log-likelihood [nats] over a Gaussian.
  double degrees = 0, student_gain = 0;
  /// Two Gaussians, the share and the relative deviation of the wide one.
  double share = 0, ratio = 1, mixture_gain = 0;
  /// Additive outliers, which leave the footprint D/C in the innovations: those found (1), per
  /// block, and the gain of taking them out; blocks empty where the noise is white.
  std::vector<Signals> found;
  double additive_gain = 0;
  /// Probability that large residuals lie so close together in time by chance.
  double clustering = 1;
};

ResidualDistribution residualDistribution(const Fit& fit, const FitData& data,
                                          const Residuals& residuals);

enum class ResidualLaw { student, mixture };

/// Whether an effect is a law of the residuals (noise_tails, sens_outliers), and which.
bool isOfResidualDistribution(const Effect& effect);
ResidualLaw lawOf(const Effect& effect);

/// Log density [nats] that the named law of residuals adds to a Gaussian one, of each experiment.
Eigen::VectorXd distributionGain(const ResidualDistribution& distribution, ResidualLaw law,
                                 const Residuals& residuals, const FitData& data);

/// The experiments without samples whose residuals are large (or, where found, without the additive
/// outliers).
std::vector<Experiment> withoutOutliers(const FitData& data, const Residuals& residuals,
                                        const ResidualDistribution& distribution);

}  // namespace uncertainty_identification
