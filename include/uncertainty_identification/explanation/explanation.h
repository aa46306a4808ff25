#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/curves/simulation_causes.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/enum_names.h"
#include "uncertainty_identification/estimation/estimate.h"
#include "uncertainty_identification/identifier.h"
#include "uncertainty_identification/own_simulation/findings.h"
#include "uncertainty_identification/own_simulation/simulation.h"

/// explain(): what the identified model gets wrong, by which physical effect, and how much the
/// model gains by including that effect.
namespace uncertainty_identification {

/// none: all checks pass without a cause. explained: causes are named, and all checks pass with
/// them. partly_explained: causes are named, but some check still fails. unknown: some check fails,
/// and no cause was found.
enum class Verdict { none, explained, partly_explained, unknown };

const EnumNames<Verdict>& enumNames(Verdict);

/// A test of the residuals of a model.
struct Check {
  std::string name;  ///< "whiteness", "variance over time", ...
  double statistic = 0;
  double p_value = 1;
  bool passed = true;
  std::string where;  ///< where it fails: frequency, time, amplitude or experiments; empty: passed
};

/// A quantity under the model without a cause and with it.
struct Comparison {
  double before = 0, after = 0;
};

/// What the model gains by a cause on experiments that were not used for fitting.
struct Gain {
  double log_density = 0;             ///< [nats] per experiment, mean of paired differences
  double standard_error = 0;          ///< of log_density; NaN with a single experiment
  double lower_90 = 0, upper_90 = 0;  ///< of the mean, by Student's t; NaN as standard_error
  Comparison nrmse_fit_percent;  ///< free simulation, as Validation::simulation_fit_percent_pooled
  Comparison coverage_50, coverage_90, coverage_95;  ///< shares of samples in prediction intervals
  Comparison noise_variance;
  /// Area of the region of the Bode magnitude diagram that contains 95 % of the linear plants, over
  /// the three decades below the Nyquist frequency [decades x decades]; NaN where Go is not stable.
  Comparison bode_area;
};

/// A parameter of a cause with its standard error and 90 % interval.
struct CauseParameter {
  std::string name, unit;
  double value = 0;
  double standard_error = 0;
  double lower_90 = 0, upper_90 = 0;
};

/// A physical effect that the data show and that the model lacked.
struct Cause {
  std::string name;         ///< e.g. "act_deadzone" (docs/explanation.md lists them)
  std::string variant;      ///< e.g. "per_experiment", or the covariate
  std::string group;        ///< "actuator", "plant", "sensor", "noise", "experiment"
  std::string description;  ///< in words
  double confidence = 0;    ///< posterior probability among the candidates; not shown where the
                            ///< verdict is partly_explained; NaN: found in the simulation, or
                            ///< explanation.time_limit ended the search before all were tried
  std::vector<std::string> equivalent;  ///< names of effects that the data may not distinguish
  std::vector<CauseParameter> parameters;
  std::string advice;  ///< what to check on the rig, or to record next
  /// None for exp_feedback, which does not change the model. Of a cause that only the simulation
  /// shows, the fit is that of held-out windows, and the rest is NaN.
  std::optional<Gain> gain;
  /// Place, shape and curve of a cause that the free simulation shows.
  std::optional<SimulationCause> simulation;
  bool seen_in_samples = false;  ///< a check of the samples shows it, without a model
};

/// An effect that was tried on top of the model.
struct TriedEffect {
  std::string name, variant;
  double score = 0;          ///< [nats] gain of log-likelihood, minus the BIC penalty
  double held_out_gain = 0;  ///< [nats] per experiment; NaN where the score is not positive
  double standard_error = 0;
};

/// Signals of one experiment, measured and simulated with the models before and after.
struct ExperimentPicture {
  std::string id;
  double sample_time = 0;  ///< [s]
  Eigen::VectorXd input, measured;
  /// Simulated with the experiment's own error parameters.
  Eigen::VectorXd simulated_before, simulated_after;
  Eigen::VectorXd deviation_before, deviation_after;  ///< standard deviation of the prediction
};

/// The residuals of one model for figures: means over the experiments.
struct ResidualPicture {
  std::vector<double> autocorrelation, cross_correlation;  ///< as in ResidualTests
  double confidence_95 = 0;                                ///< half width for a white residual
  Eigen::VectorXd frequency, spectrum;               ///< [rad/s]; relative to a white residual
  Eigen::VectorXd input_level, residual_of_input;    ///< bins of u; mean residual / deviation
  Eigen::VectorXd output_level, residual_of_output;  ///< bins of the simulated output
  Eigen::VectorXd time, residual_of_time, variance_of_time;  ///< [s]; bins over the experiment
  std::vector<double> of_experiment;  ///< root mean square of each experiment / sigma
};

/// The result of explain().
struct Explanation {
  Verdict verdict = Verdict::none;
  std::string message;  ///< in one sentence
  std::vector<Check> checks_before, checks_after;
  std::vector<Cause> causes;    ///< in the order in which they were found
  SimulationCauses simulation;  ///< what the free simulation shows, whether or not it is the answer
  std::vector<TriedEffect> candidates;
  std::vector<std::string> warnings;
  /// Models without and with the causes, from the same experiments. Both are that of identify()
  /// where it needs no cause and is the answer; pictures and residuals are then empty.
  Estimate before, after;
  /// Ids of the held-out experiments, on which the gains were measured. Empty where there were too
  /// few experiments to hold any out; the gains were then measured on those fitted to.
  std::vector<std::string> held_out;
  /// [%] fit of simulating them by the model without causes; absent: none are held out.
  std::optional<double> held_out_fit;
  ResidualPicture residual_before, residual_after;
  std::vector<ExperimentPicture> pictures;         ///< held-out experiments: median and worst fit
  Termination termination = Termination::not_run;  ///< converged, or cancelled
  double seconds = 0;                              ///< [s] wall time
  /// What the user's own simulation gets wrong, where the configuration gives one.
  std::optional<OwnSimulationFindings> own_simulation;
};

/// Explains what the model of `configuration` gets wrong on `experiments`. It looks for curves that
/// the free simulation of a small linear plant lacks. Then it identifies the model, tests its
/// residuals, and extends it by effects of the catalogue in a forward selection with backward
/// elimination, until the checks pass or no effect is accepted. Where the tests of the residuals
/// still fail, or the simulation gains much less by these effects than by the curves, the curves
/// are the answer (docs/explanation.md). What explains only a part is compared with the model that
/// identify() chooses, which may need no cause. Gains are measured on `validation`; if it is empty,
/// on a share of the experiments that is drawn with the configuration's seed and held out of the
/// fit.
///
/// `progress` returns false to cancel. The result does not depend on the number of threads. Throws
/// DataError where no experiment is usable, ConfigurationError for an invalid configuration.
Explanation explain(const Configuration& configuration, const std::vector<Experiment>& experiments,
                    const std::vector<Experiment>& validation = {},
                    const ProgressCallback& progress = {});

/// Compares the user's simulation with the experiments (docs/own_simulation.md), names what is
/// wrong with it and measures what that gains on the same held-out data as explain() does; of fewer
/// than four experiments on the last third of each. `progress` as for explain(). Throws DataError
/// where the simulation fails.
OwnSimulationFindings compareSimulation(const Configuration& configuration, Simulation& simulation,
                                        const std::vector<Experiment>& experiments,
                                        const std::vector<Experiment>& validation = {},
                                        const ProgressCallback& progress = {});

}  // namespace uncertainty_identification
