#pragma once

#include <Eigen/Core>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "uncertainty_identification/effects/chain.h"

namespace uncertainty_identification {

/// Where in the physical chain an effect sits; stages follow each other in this order.
enum class Stage {
  measurement,  ///< what the sensor's dynamics and the noise model undo: y and H, before all else
  actuator,     ///< u -> what drives the plant
  loop,         ///< feedback inside Go: input = u - f(x)
  plant,        ///< linear dynamics beside or behind Go; the error model acts on the sum
  output,       ///< behind plant and error model: x and its regressors
  noise,        ///< variance of the innovations
  data          ///< outside the chain: samples, the mixture, or the experiment itself
};

/// How the start of a candidate's fit is chosen among its starting values.
enum class ScreeningKind {
  regression,  ///< the effect moves the simulated output: a scoring step predicts its gain
  likelihood   ///< it moves variances, to which theta is nearly orthogonal: the likelihood itself
};

/// A parameter of an effect.
struct EffectParameter {
  std::string name, unit;
  double scale = 1;  ///< a typical size, the unit of steps
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool smooth = true;  ///< whether the likelihood has a useful derivative to it; if not: a search
  /// Kept as the logarithm of a variance relative to sigma^2, told as a standard deviation.
  bool log_variance = false;
};

/// What of a data set an effect chooses its scales and starting values by.
struct DataSummary {
  double input_deviation = 1;   ///< standard deviation of u over all experiments
  double output_deviation = 1;  ///< of y
  double sample_time = 1;       ///< [s]
  int experiments = 0;          ///< M
  int samples = 0;              ///< of the longest experiment
  int regressors = 0;           ///< n of the error model
  Eigen::VectorXd input_sizes, input_steps, output_sizes;  ///< sorted |u|, |u_t - u_(t-1)| > 0, |y|
  std::map<std::string, double> covariates;  ///< means of those that every experiment has and that
                                             ///< are not the same throughout
  Eigen::VectorXd starts;  ///< [s] beginnings of the experiments; empty unless they rise
  bool stamps = false;     ///< whether sampling instants off the grid are known
  std::vector<std::string> plant_parameters;  ///< theta's names as far as they move Go
  /// [rad/sample] largest peaks of the residual's spectrum: of its mean over the experiments, and
  /// of the mean of the experiments' own.
  double common_peak = 1, own_peak = 1;
};

/// The summary, but for what comes from a residual and from the model.
DataSummary summarise(const std::vector<Experiment>& experiments);

/// q-quantile of sorted values; 0 without any.
double sortedQuantile(const Eigen::VectorXd& sorted, double q);

/// What an effect is, in words and numbers.
struct EffectDescription {
  std::string name;     ///< in the catalogue, e.g. "act_deadzone"; the group is what precedes "_"
  std::string variant;  ///< where one name has several forms, which this is, e.g. "per_experiment"
  std::string meaning;  ///< e.g. "dead zone of the actuator"
  std::string advice;   ///< what to look at on the rig, or to record next
  std::vector<std::string> equivalent;  ///< names that data may not be able to tell from it
  Stage stage = Stage::output;
  ScreeningKind screening = ScreeningKind::regression;
  std::vector<EffectParameter> parameters;
  std::vector<Eigen::VectorXd> starts;  ///< of which screening takes the best; none: cannot be seen
  /// Whether the output is no longer linear in the error parameters, so that it is linearised about
  /// a point for each experiment.
  bool nonlinear = false;
  /// Whether the output is not linear in the effect's own random size either: it is linearised
  /// about a point of its own in each experiment. Its first parameter is the size's log-variance.
  bool own_point = false;
};

/// A physical effect that may be missing from a model: a decorator of the linear model at its stage
/// of the chain. Immutable. docs/adding_an_effect.md shows how to add one.
class Effect {
 public:
  explicit Effect(EffectDescription description) : description_(std::move(description)) {}
  virtual ~Effect() = default;

  const EffectDescription& description() const { return description_; }
  const std::string& name() const { return description_.name; }
  Stage stage() const { return description_.stage; }
  int parameterCount() const { return static_cast<int>(description_.parameters.size()); }

  /// Place in the physical order: effects of one stage act in rising order of it.
  int position() const { return position_; }
  void setPosition(int position) { position_ = position; }

  /// "sens_bias", or with its variant "sens_bias (per_experiment)".
  std::string label() const;

  /// Whether the parameters lie in the effect's range.
  virtual bool admissible(const Eigen::VectorXd& psi) const;

  /// Takes part in the chain at the effect's stage (all but Stage::loop and Stage::data).
  virtual void apply(const Eigen::VectorXd& psi, Chain* chain) const;

  /// The point of an experiment in which the random size is `size`, as near as the effect can
  /// follow (own_point).
  virtual double pointAt(double size, const NominalModel& nominal,
                         const Eigen::VectorXd& theta) const;

  /// Stage::measurement: what the sensor makes of a simulated signal.
  virtual void sense(const Eigen::VectorXd& /*psi*/, Signals* /*signal*/) const {}

  /// Stage::loop: what is taken from the plant's input, given its output x now and one sample
  /// before.
  virtual Lanes feedback(const Eigen::VectorXd& psi, const Lanes& x, const Lanes& before) const;

 private:
  EffectDescription description_;
  int position_ = 0;
};

using Effects = std::vector<std::shared_ptr<const Effect>>;

/// Starting values of an effect with one parameter, `factor` times those given.
std::vector<Eigen::VectorXd> values(const std::vector<double>& starts, double factor = 1);

/// The parameter of a random signal: kept as the logarithm of its variance relative to sigma^2.
EffectParameter logVariance(const std::string& name, const std::string& unit);

}  // namespace uncertainty_identification
