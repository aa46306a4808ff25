#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "uncertainty_identification/math/mixture.h"
#include "uncertainty_identification/own_simulation_options.h"
#include "uncertainty_identification/time_options.h"

/// Options of an identification. Each YAML key has the name of a field here (config/reference.yaml
/// documents them). The initialiser of a field is its default; defaults are stated nowhere else.
namespace uncertainty_identification {

enum class Structure { output_error, arx, armax, box_jenkins, continuous, modal };
enum class Focus { simulation, prediction };
enum class PlantFit { likelihood, simulation };
enum class BasisKind { fir, laguerre, kautz, sensitivity, parameter_spread, automatic };
enum class Constraint { zero_static_gain, zero_mean, free, explicit_matrix };
enum class Algorithm { em, maximum_likelihood };
/// What is known of Go before the first sample. `automatic`: zero where the first samples of at
/// least three experiments show that they start at rest, estimate elsewhere.
enum class InitialState { zero, discard, estimate, automatic };
enum class NoiseStart { zero, stationary };
enum class Offsets { automatic, none, estimate, per_experiment };
enum class OffsetSide { output, input };

/// Value of an integer option that is chosen from the data; `auto` in YAML.
constexpr int kAutomatic = -1;

/// Largest number n of free error parameters.
constexpr int kMaxErrorParameters = 10;

/// Nominal model Go = q^-delay B/A and noise model H = C/D, equations (6)-(11).
struct NominalModelOptions {
  Structure structure = Structure::box_jenkins;
  /// choose structure, nb, na, nc, nd and delay from the data; validate() refuses any that is
  /// stated beside it (YAML: `orders: auto`; `given` as soon as the structure or an order is
  /// stated)
  bool orders_auto = true;
  Focus focus = Focus::simulation;  ///< purpose of the model: criterion of the choice of orders
  /// How Go is fitted. likelihood: jointly with H and the error model (as in the paper).
  /// simulation: Go minimises the error of its free simulation; then H and the error model are
  /// estimated with this Go fixed. If the plant is not linear, the joint likelihood accepts a worse
  /// simulation for a better prediction: `orders: auto` with focus simulation then falls back on
  /// `simulation`.
  PlantFit fit = PlantFit::likelihood;
  int max_order = 8;                   ///< largest order of A that is tried, 1 to 20
  int max_delay = 20;                  ///< [samples] largest delay that is tried
  int nb = 1, na = 1, nc = 1, nd = 1;  ///< numbers of coefficients (B = b1 q^-delay + ...); those a
                                       ///< structure fixes are ignored
  int delay = 1;                       ///< nk [samples], at least 0
  // structure: continuous, G(s) = gain e^(-dead_time s) prod(1 + zero_k s) / (prod(1 + tau_k s)
  // prod(1 + 2 zeta_k s/omega_k + s^2/omega_k^2))
  int time_constants = 1;  ///< real poles tau_k [s]
  int resonances = 0;      ///< complex pole pairs (omega_k [rad/s], zeta_k [1])
  int zeros = 0;           ///< real zeros zero_k [s]
  bool dead_time = false;  ///< whether dead_time [s] is estimated (continuous in value)
  // structure: modal, a sum of time_constants real poles and resonances pairs, each with a residue
  bool feedthrough = false;  ///< whether a gain acts one sample before the modes
  /// modal: with n plant parameters, Go has the unbounded coordinates center + directions (factor -
  /// 1), and its parameters are factor1 to factorn: plants that differ in few ways, each of which
  /// moves several modes, vary along the first directions. Empty: the modes' own parameters.
  Eigen::VectorXd center;
  Eigen::MatrixXd directions;  ///< n x n, regular
  std::map<std::string, double>
      fixed;  ///< parameters of the continuous structure that are known, e.g. {gain: 1.0}

  void validate() const;
};

/// The constraint used if none is given: zero_mean where parameters of Go vary (sensitivity,
/// parameter_spread), otherwise zero_static_gain.
Constraint defaultConstraint(BasisKind basis);

/// Relative error model GDelta = sum_k eta_k F_k(q), eta = T xi, with a Gaussian mixture for xi:
/// equations (4), (12). With basis sensitivity or parameter_spread, parameters of Go vary instead
/// and xi holds their relative deviations (docs/method.md; notation in docs/notation.md).
struct ErrorModelOptions {
  /// automatic: basis, constraint and taps are chosen from the data; validate() refuses a
  /// constraint, taps (but for 0), T or parameters stated beside it.
  BasisKind basis = BasisKind::automatic;
  int taps = 2;  ///< number of basis filters, 1 to 11, or kAutomatic; 0 = no error model. Where
                 ///< parameters of Go vary it follows from them
  Constraint constraint = Constraint::zero_static_gain;
  Eigen::MatrixXd T;  ///< taps x n, for Constraint::explicit_matrix (YAML: `constraint: explicit`)
  int components = kAutomatic;              ///< kappa, 1 to 10, or kAutomatic
  double pole = 0.5;                        ///< laguerre: real pole in (-1, 1)
  double pole_real = 0.5, pole_imag = 0.3;  ///< kautz: complex pole inside the unit circle
  /// sensitivity, parameter_spread: names of the parameters of Go that vary from experiment to
  /// experiment. Empty: all of them (parameter_spread: only allowed if there is just one).
  std::vector<std::string> parameters;
  int sensitivity_order = 1;  ///< sensitivity: 1, or 2 to include products of two deviations
  int max_taps = 4, max_components = 4;  ///< limits of the automatic choice

  void validate() const;
};

/// The error model of the paper's examples: two FIR filters without static gain (YAML:
/// `error_model: paper`).
ErrorModelOptions paperErrorModel();

/// How the parameters are estimated.
struct EstimationOptions {
  Algorithm algorithm = Algorithm::maximum_likelihood;
  /// Limit for the optimisation, including scoring steps but not the search for a start. 0:
  /// evaluate the model at `initial` without optimising.
  int max_iterations = 2000;
  double tolerance = 1e-6;  ///< em: relative change of all parameters (paper, section 5);
                            ///< maximum_likelihood: predicted gain of a further step [nats]
  /// [s] after which the best estimate so far is returned (Termination::time_limit), or none where
  /// there is none yet; 0: no limit. With a limit the result can depend on the machine.
  double time_limit = 0;
  int restarts = 8;          ///< additional starts of the mixture, drawn with the seed
  int threads = kAutomatic;  ///< kAutomatic: cores - 1, at least 1, and on the command line all;
                             ///< never changes a result
  std::uint64_t seed = 1;
  InitialState initial_state = InitialState::automatic;
  int discard_samples = 50;  ///< initial_state: discard; leading samples kept out of the likelihood
  /// initial_state: estimate. Precision of an unknown initial value or own output offset of an
  /// experiment, relative to 1/sigma^2; kAutomatic: from initial_variance and a guess of sigma^2;
  /// 0: a flat prior.
  double initial_precision = kAutomatic;
  /// [unit of y, squared] The same prior's variance, which does not depend on sigma^2; kAutomatic:
  /// ten standard deviations of the outputs, squared.
  double initial_variance = kAutomatic;
  NoiseStart noise_start = NoiseStart::stationary;
  /// estimate: one offset common to all experiments; per_experiment: one each; automatic: one each
  /// where the data speak for it.
  Offsets offsets = Offsets::automatic;
  /// Each so manieth sample is fitted to, the input averaged in between, so that the model has a
  /// longer sample time; kAutomatic: as the bandwidth of the outputs allows where the orders are
  /// automatic, no sample time is stated and no effects are, elsewhere 1. An estimate has the
  /// number used.
  int thinning = kAutomatic;
  OffsetSide offset_side =
      OffsetSide::output;  ///< where the offset enters (both together are collinear)

  void validate() const;
};

/// Starting values, or with max_iterations 0 the point at which to evaluate. Values that are absent
/// are chosen from the data.
struct InitialOptions {
  Eigen::VectorXd theta;  ///< b, a, c, d concatenated (continuous: its physical parameters, then c,
                          ///< d); empty = absent
  Mixture mixture;        ///< YAML: weights, means, covariances; no components = absent
  std::optional<double> noise_variance;

  void validate() const;
};

enum class InputResampling { hold };
enum class OutputResampling { hold, linear, mean };

/// How time-stamped signals are resampled to a uniform grid.
struct ResamplingOptions {
  InputResampling input = InputResampling::hold;  ///< zero-order hold, as actuators do
  OutputResampling output = OutputResampling::hold;
  double max_age = 0;  ///< [s] older samples count as missing; 0 = three sample times
  double max_jitter =
      0;  ///< [s] largest accepted deviation of stamps from the grid; 0 = any (only reported)

  void validate() const;
};

/// Where a signal comes from: from a topic, live or in a bag, or from a column of a CSV file.
struct SignalOptions {
  std::string name;  ///< covariates only: the name under which it is stored
  std::string topic;
  std::string field = "auto";  ///< numeric field of the topic's messages; auto: the only one
  std::string column = "";     ///< name of the column in files; empty: u, y or the covariate's name
  /// What is stored is scale * value + offset (YAML: `scale: deg` for pi/180).
  double scale = 1, offset = 0;

  double scaled(double value) const { return scale * value + offset; }
};

enum class ExperimentMode { topic, service, duration, gap, message };

/// What divides the stream of samples into experiments.
struct ExperimentOptions {
  ExperimentMode mode = ExperimentMode::topic;
  std::string topic = "experiment/active";  ///< std_msgs/Bool or ExperimentMarker (mode topic),
                                            ///< Experiment (mode message)
  double duration = 0;                      ///< [s], mode duration
  double gap = 0;      ///< [s], mode gap: an experiment ends when no sample arrives for this long
  std::string column;  ///< of a CSV file: names the experiment of each row; empty: `experiment`

  void validate() const;
};

/// Bounds: which properties of the plant's distribution are computed.
struct BoundsOptions {
  std::vector<double> levels = {0.5, 0.9, 0.95, 0.99};  ///< shares of plants, each in (0, 1)
  int frequencies = 500;   ///< points of the automatic grid; 0 = no bounds are computed
  Eigen::VectorXd grid;    ///< [rad/s] ascending, up to the Nyquist frequency; empty = automatic
  int steps = kAutomatic;  ///< samples of the step responses; kAutomatic: until Go has settled
  int samples = 2000;      ///< number of plants drawn
  int weight_order = kAutomatic;  ///< of the robust-control weight, 0 to 8; kAutomatic: the lowest
                                  ///< that over-bounds by at most a tenth (median)
  double weight_level =
      0.95;        ///< share of plants that the weight covers at all frequencies simultaneously
  int folds = 10;  ///< of the calibration of prediction intervals (CV+); 0 = no calibration

  void validate() const;
};

/// An effect of the catalogue (effects/catalogue.h) that extends the linear model, its
/// parameters estimated with the others.
struct EffectOptions {
  std::string name;  ///< e.g. "act_deadzone"
  std::string
      variant;  ///< where an effect has several, e.g. "per_experiment" or a covariate's name
  std::map<std::string, double> parameters;  ///< start values; absent: from the data
};

/// Options of the search for causes of simulation errors.
struct ExplanationOptions {
  int max_causes = 4;  ///< largest number of causes, 0 to 10
  double acceptance =
      6;  ///< [nats] gain in log-likelihood beyond the penalty that a cause needs, above 0
  double validation_share =
      0.3;  ///< share of experiments held out if none are given for validation, in (0, 0.9]
  /// [s] after which no further cause is searched for, and the best answer so far is given; 0: none
  double time_limit = 20;
  std::vector<std::string> exclude;  ///< names of catalogue effects that are not considered
  int after_experiments =
      0;  ///< the node explains after this many new experiments; 0 = only on request

  void validate() const;
};

/// When a running node identifies from scratch. Otherwise it starts from the previous result, which
/// is fast but stays at a local optimum.
struct FullIdentificationOptions {
  double share = 0.1;  ///< share of experiments that are new since the last full identification, 0
                       ///< to 1; 0 = always
  double quiet = 1;    ///< [s] a full identification also follows after this time without new
                       ///< experiments; 0 = never

  void validate() const;
};

/// Limits of what is stored and accepted.
struct LimitOptions {
  int max_experiments = 1000;  ///< only the newest are kept and identified from
  int max_samples = 1000000;   ///< per experiment; an experiment is closed when it reaches them
  int min_samples = 20;        ///< shorter experiments are rejected
  double max_missing = 0.5;    ///< largest share of missing output samples accepted, in [0, 1)
  double max_stray = 0.05;     ///< largest share of single output readings that stray from both
                            ///< their neighbours and count as missing, in [0, 0.05]; 0: none does
  int max_request_size = 256;  ///< [MiB] of a request with experiments
  int max_bag_size =
      4096;  ///< [MiB] of the bags that a request names, and of their uncompressed contents
  int max_saved_files = 100;     ///< number of files that requests may write
  double max_request_time = 60;  ///< [s] that a request to identify may compute, above 0

  void validate() const;
};

/// Everything that determines a result, given the data.
struct Configuration {
  double sample_time = 0;  ///< [s]; 0 = auto: the median spacing of the stamps
  NominalModelOptions nominal_model;
  ErrorModelOptions error_model;
  EstimationOptions estimation;
  InitialOptions initial;
  std::vector<EffectOptions> effects;  ///< extend the linear model
  ExplanationOptions explanation;
  std::optional<OwnSimulationOptions> simulation;  ///< of the user, which explain compares
  ResamplingOptions resampling;
  SignalOptions input{"", "actuator/command", "auto"};
  SignalOptions output{"", "sensor/measurement", "auto"};
  std::vector<SignalOptions> covariates;
  TimeOptions time;
  ExperimentOptions experiment;
  FullIdentificationOptions full_identification;
  BoundsOptions bounds;
  LimitOptions limits;
  std::string
      bag_directory;  ///< folder of the bags that requests name; empty = such names are refused
  std::string report_directory;  ///< folder in which reports are written; empty = none are written
  bool report_each_result = false;  ///< write report.html there after each result
  int live_page_port = 0;  ///< of the page for browsers, on 127.0.0.1 (docs/live_page.md); 0 = none
  std::string store_directory;  ///< folder in which finished experiments are stored; empty = none

  /// Throws ConfigurationError naming key, value and allowed range.
  void validate() const;
};

}  // namespace uncertainty_identification
