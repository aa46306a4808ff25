#pragma once

#include <Eigen/Core>
#include <optional>

#include "simulation/field.h"

/// Effects of how the experiments are made and recorded.
namespace uncertainty_identification {

/// The experiments run in closed loop: u(t) = r(t) - gain y(t - 1), where r is drawn as InputTruth
/// says. The controller reads y before exp_clock and exp_jitter distort the record.
struct FeedbackTruth {
  double gain = 0.1;  ///< [unit of u/unit of y]
  Fields fields() { return {{"gain", &gain}}; }
};

/// A further mode of operation: with probability `weight`, xi ~ N(mean, deviation^2 I) takes the
/// place of what the mixture drew.
struct ModeTruth {
  double weight = 0.2;
  Eigen::VectorXd mean = Eigen::VectorXd::Constant(1, 1);  ///< one entry for each entry of xi
  double deviation = 0.1;
  Fields fields() {
    return {{"weight", &weight, range::kBelowOne},
            {"mean", &mean},
            {"deviation", &deviation, range::kNotNegative}};
  }
};

/// A second input, the covariate `d`, acts on the plant's output: it adds
/// gain (1 - pole) q^-1/(1 - pole q^-1) d to x.
struct SecondInputTruth {
  double gain = 0.5;  ///< [unit of y/unit of d]
  double pole = 0.5;
  Fields fields() { return {{"gain", &gain}, {"pole", &pole, range::kInsideCircle}}; }
};

/// The clocks of input and output differ: y_r(t) = x_r(t + tau_r) + v_r(t), where
/// tau_r ~ N(0, deviation^2) is drawn for each experiment.
struct ClockTruth {
  double deviation = 0.5;  ///< [samples]
  Fields fields() { return {{"deviation", &deviation, range::kNotNegative}}; }
};

/// The output is sampled at k + delta_k, delta_k uniform within -width ... width, and recorded with
/// that time: Experiment::stamp_offset is delta_k sample_time [s]. In general
/// y_k = x(k + coupling delta_k) + v_k, so that with coupling 0 only the time stamps jitter.
struct JitterTruth {
  double width = 0.2;   ///< [samples]; up to 0.2 a file is read back reliably
  double coupling = 1;  ///< 1: the stamps are true; 0: the samples are evenly spaced
  Fields fields() { return {{"width", &width, range::kBelowHalf}, {"coupling", &coupling}}; }
};

/// Each effect is absent or has its parameters.
struct ExperimentEffects {
  std::optional<FeedbackTruth> feedback;
  std::optional<ModeTruth> mode;
  std::optional<SecondInputTruth> input2;
  std::optional<ClockTruth> clock;
  std::optional<JitterTruth> jitter;
};

}  // namespace uncertainty_identification
