#pragma once

#include <Eigen/Core>
#include <optional>

/// Effects on how experiments are made and recorded, for a truth to hide.
namespace uncertainty_identification {

/// The recorded input is u(t) = r(t) - gain y(t - 1), r what makeInput() draws: closed loop. The
/// controller reads the sensor itself, not the record that exp_clock and exp_jitter distort.
struct FeedbackTruth {
  double gain = 0.1;  ///< [unit of u/unit of y]
};

/// A further component of the mixture: with probability `weight`, xi ~ N(mean, deviation^2 I)
/// instead of what the mixture drew.
struct ModeTruth {
  double weight = 0.2;                                     ///< at least 0 and below 1
  Eigen::VectorXd mean = Eigen::VectorXd::Constant(1, 1);  ///< n
  double deviation = 0.1;                                  ///< 0 or above
};

/// x += gain (1 - pole) q^-1/(1 - pole q^-1) d, with the covariate `d`.
struct SecondInputTruth {
  double gain = 0.5;  ///< [unit of y/unit of d]
  double pole = 0.5;  ///< between -1 and 1
};

/// y_r(t) = x_r(t + tau_r) + v_r(t), tau_r ~ N(0, deviation^2) per experiment.
struct ClockTruth {
  double deviation = 0.5;  ///< [samples], 0 or above
};

/// The output is sampled at k + delta_k, delta_k uniform within +- width, and stamped so:
/// Experiment::stamp_offset is delta_k sample_time [s]. With coupling 0 the stamps jitter and the
/// sampling does not: y_k = x(k + coupling delta_k) + v_k.
struct JitterTruth {
  double width =
      0.2;  ///< [samples], at least 0 and below 0.5; files are read back reliably up to 0.2
  double coupling = 1;  ///< 1: true stamps; 0: a decoy
};

struct ExperimentEffects {
  std::optional<FeedbackTruth> feedback;
  std::optional<ModeTruth> mode;
  std::optional<SecondInputTruth> input2;
  std::optional<ClockTruth> clock;
  std::optional<JitterTruth> jitter;

  void validate() const;
};

}  // namespace uncertainty_identification
