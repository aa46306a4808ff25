#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/rejected_experiment.h"
#include "uncertainty_identification/math/mixture.h"

namespace uncertainty_identification {

/// Why an estimation ended.
enum class Termination { not_run, converged, iteration_limit, stalled, cancelled, time_limit };

/// The word used in result.json: "converged", "iteration_limit", ...
std::string toString(Termination termination);

/// A scalar parameter with its standard errors.
struct ParameterEstimate {
  std::string
      name;  ///< "b1", "tau1", "weight2", "mean1[1]", "covariance2[1,1]", "noise_variance", ...
  std::string unit;  ///< empty if it follows from the units of u and y
  double value = 0;
  double standard_error = 0;         ///< from the observed information; NaN where it is singular
  double robust_standard_error = 0;  ///< sandwich form from the scores of experiments, or of their
                                     ///< parts; valid when the model is wrong
};

/// Go = q^-delay B/A and H = C/D as polynomials in q^-1, and the parameters theta that they were
/// computed from.
struct NominalModelEstimate {
  std::string structure;    ///< as in the configuration
  double sample_time = 0;   ///< [s]
  int delay = 0;            ///< nk [samples]
  Eigen::VectorXd b;        ///< b1..b_nb: B = b1 + b2 q^-1 + ..., without the delay
  Eigen::VectorXd a, c, d;  ///< without the leading 1
  std::vector<ParameterEstimate> parameters;  ///< theta
  Eigen::MatrixXd covariance;                 ///< of `parameters`, from the observed information
};

/// The relative error model GDelta(eta) = sum_k eta_k F_k, eta = T xi (docs/notation.md).
struct ErrorModelEstimate {
  ErrorModelOptions options;  ///< basis and constraint, with the number of taps used
  Eigen::MatrixXd T;          ///< taps x n
  Mixture mixture;            ///< of xi, components sorted
  std::vector<ParameterEstimate>
      parameters;  ///< weights, means, covariance entries with standard errors
};

/// An effect that extends the linear model, with its estimated parameters.
struct EffectEstimate {
  std::string name, variant;  ///< as in the configuration
  std::vector<ParameterEstimate> parameters;
};

/// What the model infers about one experiment that it was fitted to.
struct ExperimentEstimate {
  std::string id;
  int samples = 0;  ///< number of measured samples
  std::vector<double>
      responsibilities;        ///< posterior probability of each component, zeta_ir of (23)
  Eigen::VectorXd error_mean;  ///< posterior mean of xi, from (31)
  double log_likelihood = 0;
};

/// A candidate of an automatic choice.
struct Candidate {
  std::string choice;                    ///< "orders", "components", "taps"
  std::string description;               ///< e.g. "output_error nb=2 na=2 delay=1"
  int parameters = 0;                    ///< number of free parameters
  std::optional<double> log_likelihood;  ///< absent if the candidate could not be fitted
  std::optional<double> bic;             ///< likewise
  std::optional<double>
      validation_fit;  ///< simulation fit on held-out data [%]; absent if not used
  bool chosen = false;
  /// mean log density of experiments that it was not fitted to [nats]; absent if not used
  std::optional<double> held_out_density{};
};

/// Fit on held-out experiments; `experiments` is empty if there are none.
struct Validation {
  std::vector<std::string> experiments;  ///< ids
  std::vector<double>
      simulation_fit_percent;  ///< 100 (1 - |y - ysim| / |y - mean y|), free simulation of Go
  double simulation_fit_percent_pooled = 0;  ///< the same with the mean over all of them
  double at_rest_fit_percent_pooled = 0;  ///< the same if every simulation starts at rest instead
                                          ///< of the state that fits its first samples
  double log_density_per_experiment = 0;  ///< mean log predictive density [nats]
};

/// Tests whether the residuals are white, uncorrelated with the input, and those of a linear plant,
/// pooled over all experiments (residual_tests/residual_tests.h). Empty if there are too few
/// residuals or the tests were not computed.
struct ResidualTests {
  long samples = 0;                     ///< number of residuals
  std::vector<double> autocorrelation;  ///< at lags 1, 2, ...; standard deviation 1/sqrt(samples)
  std::vector<double>
      cross_correlation;  ///< with the input k = 0, 1, ... samples earlier; same standard deviation
  double whiteness_p_value = 0;     ///< of a portmanteau test of the autocorrelation
  double independence_p_value = 0;  ///< of a test of all cross-correlations together
  double linearity_p_value = 1;     ///< of a test against what a plant that is not linear would add
  double nonlinear_share = 0;       ///< of the residuals' variance that this would explain
};

/// The step of one iteration, in the coordinates that the method uses.
struct StepSummary {
  double norm = 0;  ///< Euclidean norm; 0 if no step was found or L-BFGS evaluates its start
  double gradient_norm = 0;  ///< of the log-likelihood, at the point before the step
  bool accepted = false;     ///< false: the step was rejected and the point did not change
  double seconds = 0;        ///< [s] wall time
};

/// The state of the optimisation after one iteration.
struct TracePoint {
  int iteration = 0;
  int passes = 0;             ///< sweeps over all samples so far
  double log_likelihood = 0;  ///< highest so far
  /// Absent if there was no step: at the start of L-BFGS, and in results of older versions.
  std::optional<StepSummary> step{};
};

/// How far the data leave the plant open where its orders were chosen from them: dynamics beyond
/// what noise and input let them show cannot have been found. Bounds include it.
struct StructureError {
  Eigen::VectorXd omega;  ///< [rad/s], ascending; empty: the orders were stated, or are not known
  /// Standard error, relative to |Go|, of a response that is estimated without any structure in the
  /// octave about each frequency.
  Eigen::VectorXd relative;
};

/// Whether a result's distribution of plants, and so its bounds, can be relied on.
struct Trust {
  bool trusted = true;
  std::vector<std::string> reasons;  ///< why not, one sentence each, the gravest first
};

/// The result of an identification, with all that is needed to use and reproduce it.
struct Estimate {
  Configuration configuration;  ///< as used: automatic choices are replaced by their results
  std::string version;
  std::string data_fingerprint;  ///< hash of the experiments used, independent of their order
  int experiment_count = 0;      ///< number M of experiments used
  long sample_count = 0;         ///< measured output samples used
  std::vector<RejectedExperiment> rejected;

  NominalModelEstimate nominal_model;
  ErrorModelEstimate error_model;
  std::vector<EffectEstimate> effects;
  /// Covariance of the estimation errors of plant and mixture in unbounded coordinates:
  /// [plantCoordinates(b, a); MixtureCoordinates]; if the error model varies parameters of Go,
  /// [NominalModel::toUnbounded(theta); MixtureCoordinates]. Bounds that include estimation errors
  /// use it. Empty if the estimation was cancelled.
  Eigen::MatrixXd joint_covariance;
  ParameterEstimate noise_variance{"noise_variance", "", 0, 0, 0};
  double offset_u = 0, offset_y = 0;  ///< common offsets; 0 if not estimated

  double log_likelihood = 0;  ///< observed, without penalty
  double bic = 0;             ///< -2 log-likelihood + penalty (docs/method.md)
  Termination termination = Termination::not_run;
  std::string message = "the estimation was not run";
  int iterations = 0;
  int passes = 0;      ///< sweeps over all samples
  double seconds = 0;  ///< [s] wall time
  std::vector<TracePoint> trace;
  std::vector<ExperimentEstimate> experiments;
  std::vector<Candidate> candidates;
  /// 100 (1 - |y - ysim| / |y - mean y|) [%] of the free simulation of Go, over the experiments
  /// that the model was identified from; about the mean of each experiment where offsets are of
  /// each, otherwise about that of all. Absent in results of older versions.
  std::optional<double> simulation_fit_percent;
  Validation validation;
  ResidualTests residual_tests;
  std::string variation;  ///< how the plants differ from experiment to experiment, in a sentence
  bool has_odd_experiments = false;  ///< not all belong together; a warning names those that do not
  StructureError structure_error;
  Trust trust;
  std::vector<std::string> warnings;

  /// Whether the model can be used: the estimation converged, or stopped at the iteration or the
  /// time limit with finite parameters.
  bool usable() const;
};

}  // namespace uncertainty_identification
