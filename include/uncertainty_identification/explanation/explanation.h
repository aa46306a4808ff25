#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/enum_names.h"
#include "uncertainty_identification/estimation/estimate.h"
#include "uncertainty_identification/identifier.h"

/// What the simulation (the identified model) gets wrong, why, and what naming the cause gains.
namespace uncertainty_identification {

/// none: nothing is wrong. explained: causes are named and all checks pass with them.
/// partly_explained: causes are named, some check still fails. unknown: some check fails and no
/// cause was found.
enum class Verdict { none, explained, partly_explained, unknown };

const EnumNames<Verdict>& enumNames(Verdict);

/// A test of what a model leaves of the data.
struct Check {
  std::string name;  ///< "whiteness", "variance over time", ...
  double statistic = 0;
  double p_value = 1;
  bool passed = true;
  std::string where;  ///< frequency band, time, amplitude or experiments it shows in; empty: passed
};

/// A quantity before and after a cause is taken into the model.
struct Comparison {
  double before = 0, after = 0;
};

/// What taking a cause into the model gains on experiments not used for fitting.
struct Gain {
  double log_density = 0;             ///< [nats] per experiment, mean of paired differences
  double standard_error = 0;          ///< NaN: no two experiments tell it
  double lower_90 = 0, upper_90 = 0;  ///< of the mean, by Student's t; NaN as standard_error
  Comparison nrmse_fit_percent;  ///< free simulation, as Validation::simulation_fit_percent_pooled
  Comparison coverage_50, coverage_90, coverage_95;  ///< shares of samples in prediction intervals
  Comparison noise_variance;
  /// Of the region that holds 95 % of the linear plants, in the three decades below the Nyquist
  /// frequency [decades x decades]; NaN where Go is not stable.
  Comparison bode_area;
};

/// A parameter of a cause with its standard error and 90 % interval.
struct CauseParameter {
  std::string name, unit;
  double value = 0;
  double standard_error = 0;
  double lower_90 = 0, upper_90 = 0;
};

/// A physical effect that the data show and the model lacked.
struct Cause {
  std::string name;                     ///< of the catalogue, e.g. "act_deadzone"
  std::string variant;                  ///< e.g. "per_experiment", or the covariate
  std::string group;                    ///< "actuator", "plant", "sensor", "noise", "experiment"
  std::string description;              ///< in words
  double confidence = 0;                ///< posterior probability among the candidates
  std::vector<std::string> equivalent;  ///< names that the data cannot tell from it
  std::vector<CauseParameter> parameters;
  std::string advice;        ///< what to look at on the rig, or to record next
  std::optional<Gain> gain;  ///< none where taking it in gains no likelihood (exp_feedback)
};

/// An effect that was tried.
struct TriedEffect {
  std::string name, variant;
  double score = 0;          ///< [nats] gain of training likelihood less its penalty
  double held_out_gain = 0;  ///< [nats] per experiment; NaN where the score is not positive
  double standard_error = 0;
};

/// One experiment as the models before and after see it.
struct ExperimentPicture {
  std::string id;
  double sample_time = 0;  ///< [s]
  Eigen::VectorXd input, measured;
  Eigen::VectorXd simulated_before, simulated_after;  ///< given the experiment's own error
  Eigen::VectorXd deviation_before, deviation_after;  ///< standard deviation of the prediction
};

/// What is left of the data by one model, for figures: means over the experiments.
struct ResidualPicture {
  std::vector<double> autocorrelation, cross_correlation;  ///< as in ResidualTests
  double confidence_95 = 0;                                ///< half width for a white residual
  Eigen::VectorXd frequency, spectrum;               ///< [rad/s]; relative to a white residual
  Eigen::VectorXd input_level, residual_of_input;    ///< bins of u; mean residual / deviation
  Eigen::VectorXd output_level, residual_of_output;  ///< bins of the simulated output
  Eigen::VectorXd time, residual_of_time, variance_of_time;  ///< [s]; bins over the experiment
  std::vector<double> of_experiment;  ///< root mean square of each experiment / sigma
};

/// The answer to "what does the simulation get wrong?".
struct Explanation {
  Verdict verdict = Verdict::none;
  std::string message;  ///< in one sentence
  std::vector<Check> checks_before, checks_after;
  std::vector<Cause> causes;  ///< in the order in which they were found
  std::vector<TriedEffect> candidates;
  std::vector<std::string> warnings;
  Estimate before, after;  ///< models without and with the causes, from the same experiments
  /// Ids of the experiments that the gains were measured on; none: those fitted to, as there were
  /// too few to keep any out.
  std::vector<std::string> held_out;
  ResidualPicture residual_before, residual_after;
  std::vector<ExperimentPicture> pictures;         ///< held-out experiments: median and worst fit
  Termination termination = Termination::not_run;  ///< converged, or cancelled
  double seconds = 0;                              ///< [s] wall time
};

/// Explains `experiments`: identifies the model that `configuration` names, tests what it leaves,
/// screens the catalogue of effects, takes the best into the model, measures the gain on
/// experiments kept out of the fit (`validation`; none: a seeded share of the experiments), and so
/// on until the checks pass or nothing helps (docs/explanation.md). Throws DataError when no usable
/// experiment is left, ConfigurationError for a configuration that is not valid. The answer does
/// not depend on the number of threads.
Explanation explain(const Configuration& configuration, const std::vector<Experiment>& experiments,
                    const std::vector<Experiment>& validation = {},
                    const ProgressCallback& progress = {});

}  // namespace uncertainty_identification
