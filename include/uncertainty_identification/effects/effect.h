#pragma once

#include <Eigen/Core>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "uncertainty_identification/effects/chain.h"

namespace uncertainty_identification {

/// Where in the physical chain an effect acts. The likelihood is computed stage by stage, in this
/// order.
enum class Stage {
  measurement,  ///< the sensor's dynamics and the noise model, which are inverted before all else
  actuator,     ///< from the command u to the input of the plant
  loop,         ///< feedback inside Go: the plant's input is u - f(x)
  plant,        ///< linear dynamics in parallel to or in series with Go; the error model acts on x
  output,       ///< behind plant and error model: x and its derivatives
  noise,        ///< the variance of the innovations
  data          ///< outside the chain: the samples, the mixture, or the experiment itself
};

/// How screening predicts what an effect would gain from each of its starting values.
enum class ScreeningKind {
  regression,  ///< by a scoring step: for effects that change the simulated output
  likelihood   ///< by the likelihood with theta fixed: for effects that change variances, with
               ///< which estimates of theta hardly correlate
};

/// What else the search for causes must know of an effect. Traits are declared by the effect, so
/// that the search needs to know no effect by its name.
enum class Trait {
  order,          ///< linear dynamics, which a model of higher order or longer delay has as well
  moves_plant,    ///< changes the best theta so much that fits must begin at new starts of it
  many_optima,    ///< the likelihood has many local maxima: fits must begin at each start
  in_mixture,     ///< the mixture of the base model may have absorbed it: fits must restart that
  differencing,   ///< near the upper limit of its parameter it takes differences of the data, and
                  ///< so would absorb any drift
  of_mixture,     ///< estimated from whole experiments, not from samples
  new_component,  ///< one more component of the mixture
  noise_poles,    ///< more poles of the noise model, which may have taken the place of others
  of_noise,       ///< changes no simulation, as all effects of Stage::noise
  heavy_tails,    ///< all innovations are distributed with heavier tails than Gaussian
  outliers,       ///< some samples are
  one_cause,      ///< its forms contain each other, and are no rivals
  own_shifts,     ///< its points are shifts in time, and are found by a search of their own
  quantisation,   ///< seen in the samples: they lie on a lattice
  held_samples,   ///< seen in the samples: they repeat
  output_limit,   ///< may be seen in the samples: they crowd at the lowest or highest
  feedback,       ///< seen in the input: it depends on the output
  spectral_line,  ///< a line in the spectrum, as resonances that the model lacks have nearly, too
  by_experiment,  ///< of another size in each experiment, which one or two cannot show
  constant        ///< a constant, which differs from the model's offset only where a record begins
};

/// A parameter of an effect.
struct EffectParameter {
  std::string name, unit;
  double scale = 1;  ///< a typical size; steps of finite differences are a share of it
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool smooth = true;  ///< whether the likelihood is differentiable in it; otherwise it is found by
                       ///< a search without derivatives
  /// Whether the model has the logarithm of a variance relative to sigma^2 as its parameter, and
  /// results state the standard deviation instead.
  bool log_variance = false;
};

/// What effects need to know of a data set to choose their scales and starting values.
struct DataSummary {
  double input_deviation = 1;   ///< standard deviation of u over all experiments
  double output_deviation = 1;  ///< of y
  double sample_time = 1;       ///< [s]
  int experiments = 0;          ///< M
  int samples = 0;              ///< N of the longest experiment
  int regressors = 0;           ///< n of the error model
  Eigen::VectorXd input_sizes, input_steps, output_sizes;  ///< sorted |u|, |u_t - u_(t-1)| > 0, |y|
  std::map<std::string, double> covariates;  ///< means of the covariates that every experiment has
                                             ///< and that vary over the data set
  Eigen::VectorXd starts;  ///< [s] when the experiments began; empty unless the times rise
  bool stamps = false;     ///< whether stamps tell that samples were taken off the grid
  std::vector<std::string> plant_parameters;  ///< names of the parameters of Go, which come first
                                              ///< in theta
  /// [rad/sample] frequency of the largest peak in the spectrum of the mean residual over all
  /// experiments, and of that in the mean of the spectra of the experiments' residuals.
  double common_peak = 1, own_peak = 1;
  /// [unit of u] step in which the residuals show that the actuator moves, and a level of it; 0:
  /// none
  double input_step = 0, input_level = 0;
};

/// Summarises the recorded data. What depends on a model keeps its default: `regressors`,
/// `plant_parameters`, the peaks of the residuals' spectra and the steps of the actuator.
DataSummary summarise(const std::vector<Experiment>& experiments);

/// q-quantile of sorted values; 0 if there are none.
double sortedQuantile(const Eigen::VectorXd& sorted, double q);

/// What an effect is, in words and numbers.
struct EffectDescription {
  std::string name;     ///< group, "_" and what it is, e.g. "act_deadzone"
  std::string variant;  ///< which form of the effect this is, e.g. "per_experiment"; empty where
                        ///< the name has only one
  std::string meaning;  ///< what is wrong, as a noun phrase, e.g. "dead zone of the actuator"
  std::string advice;   ///< what to check on the rig, or to record next, as a sentence
  std::vector<std::string> equivalent;  ///< names of effects that the data may not distinguish
  Stage stage = Stage::output;
  ScreeningKind screening = ScreeningKind::regression;
  std::vector<EffectParameter> parameters;
  /// Parameter vectors from which fits may start; screening chooses the best. Empty for
  /// Stage::data, and where the data do not show where to start: the search does not try the effect
  /// then.
  std::vector<Eigen::VectorXd> starts;
  /// Whether the effect makes the output nonlinear in the error parameters xi. The output is then
  /// linearised about a value of xi in each experiment.
  bool nonlinear = false;
  /// Whether the output is not linear in the effect's random size either, which is then linearised
  /// about a point of its own in each experiment. The effect's first parameter must be the
  /// log-variance of that size.
  bool own_point = false;
  std::vector<Trait> traits = {};
  std::vector<std::string> excludes = {};  ///< names of effects that have nothing left to describe
                                           ///< where this one is there, and the reverse
  double least_score = 0;  ///< [nats] that it has to gain; 0: explanation.acceptance
};

/// A physical effect that may be missing from a model. It changes the signals of the chain at its
/// stage and knows nothing of other effects. Immutable. docs/adding_an_effect.md shows how to add
/// one.
class Effect {
 public:
  explicit Effect(EffectDescription description) : description_(std::move(description)) {}
  virtual ~Effect() = default;

  const EffectDescription& description() const { return description_; }
  const std::string& name() const { return description_.name; }
  Stage stage() const { return description_.stage; }
  bool has(Trait trait) const;
  int parameterCount() const { return static_cast<int>(description_.parameters.size()); }

  /// Place in the catalogue. Effects of one stage act in rising order of it.
  int position() const { return position_; }
  void setPosition(int position) { position_ = position; }

  /// "sens_bias", or with its variant "sens_bias (per_experiment)".
  std::string label() const;

  /// Whether the parameters lie within their limits.
  virtual bool admissible(const Eigen::VectorXd& psi) const;

  /// Changes the signals of the chain at the effect's stage. Effects of Stage::loop and Stage::data
  /// do not have it.
  virtual void apply(const Eigen::VectorXd& psi, Chain* chain) const;

  /// The point about which an effect with own_point is linearised in an experiment where its random
  /// size is `size`; limited to what the effect can compute. It need not be in the unit of `size`:
  /// the point may be the value of the parameter that varies.
  virtual double pointAt(double size, const NominalModel& nominal,
                         const Eigen::VectorXd& theta) const;

  /// Stage::measurement: applies the sensor's dynamics to a simulated signal.
  virtual void sense(const Eigen::VectorXd& /*psi*/, Signals* /*signal*/) const {}

  /// Stage::loop: f(x), which is subtracted from the plant's input, given the plant's output x now
  /// and one sample `before`.
  virtual Lanes feedback(const Eigen::VectorXd& psi, const Lanes& x, const Lanes& before) const;

 private:
  EffectDescription description_;
  int position_ = 0;
};

using Effects = std::vector<std::shared_ptr<const Effect>>;

/// Starting values of an effect with one parameter, `factor` times those given.
std::vector<Eigen::VectorXd> values(const std::vector<double>& starts, double factor = 1);

/// The size of a random signal as a parameter: the logarithm of its variance relative to sigma^2.
EffectParameter logVariance(const std::string& name, const std::string& unit);

}  // namespace uncertainty_identification
