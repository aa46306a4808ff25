#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/linear_model.h"
#include "model/noise_whitening.h"
#include "uncertainty_identification/effects/effect.h"

namespace uncertainty_identification {

/// An effect with values for its parameters.
struct SetEffect {
  const Effect* effect;
  Eigen::VectorXd psi;
  Eigen::Index own_point = -1;  ///< row of its point; -1 where it has none
};

/// The linear model extended by effects, which act in physical order. Its parameters are those of
/// the linear model, then those of the effects in the order given. Initial states, offsets and
/// missing outputs are treated as in the linear model. Derivatives are finite differences of the
/// whole chain, so that effects combine without knowing of each other.
class ExtendedModel : public LinearModel {
 public:
  /// The steps of finite differences follow from `scales`. `experiments` is the number M of
  /// experiments in the data set of the blocks. `points` as for linearisedAbout(); empty: zero.
  ExtendedModel(std::shared_ptr<const NominalModel> nominal, const ErrorBasis& basis,
                const EstimationOptions& options, Effects effects, const DataSummary& scales,
                int experiments, Eigen::MatrixXd points = {});

  const Effects& effects() const { return effects_; }

  /// Index of the first parameter of effect k among all parameters.
  int offsetOf(std::size_t k) const { return offsets_[k]; }
  int effectParameterCount() const { return count_ - static_cast<int>(own()); }
  Eigen::VectorXd psi(const Eigen::VectorXd& parameters, std::size_t k) const;

  /// The same model with other effects, or for a data set of another number of experiments.
  std::unique_ptr<ExtendedModel> with(Effects effects) const;
  std::unique_ptr<ExtendedModel> forExperiments(int experiments) const;

  std::vector<std::string> names() const override;
  std::vector<ParameterRole> roles() const override;
  ReportedValue reported(std::size_t k, double value, double noise_variance) const override;
  double fromReported(std::size_t k, double reported, double noise_variance) const override;
  Eigen::VectorXd withStartingValues(const Eigen::VectorXd& start,
                                     const std::vector<EffectOptions>& effects) const override;
  void evaluate(const Block& block, const Eigen::VectorXd& parameters, bool derivatives,
                Response* response) const override;
  std::unique_ptr<const FusedSweep> prepare(const std::vector<Block>& blocks,
                                            const Eigen::VectorXd& parameters,
                                            bool derivatives) const override;
  bool admissible(const Eigen::VectorXd& parameters) const override;
  Eigen::VectorXd toUnbounded(const Eigen::VectorXd& parameters) const override;
  Eigen::VectorXd fromUnbounded(const Eigen::VectorXd& unbounded) const override;
  Eigen::MatrixXd unboundedJacobian(const Eigen::VectorXd& unbounded) const override;

  /// Posterior means of the coefficients of all columns in one lane, given the part of the
  /// residual that the regressors leave `unexplained`.
  static Eigen::VectorXd columnCoefficients(const Response& response, const Signals& unexplained,
                                            int lane);

  /// Points have a column per experiment and n rows for xi, then a row for each effect with a point
  /// of its own, in the order of effects(). points() takes xi as given and leaves the effects' own
  /// points unchanged; pointsOf() estimates them from the data.
  bool isLocallyLinear() const override;
  Eigen::MatrixXd points(const Eigen::VectorXd& parameters,
                         const Eigen::MatrixXd& xi) const override;
  Eigen::MatrixXd pointsOf(const std::vector<Block>& blocks, const Eigen::VectorXd& parameters,
                           const Eigen::MatrixXd& xi) const override;
  Eigen::VectorXd pointDeviations(const Eigen::VectorXd& parameters, double noise_variance,
                                  const Eigen::VectorXd& of_xi) const override;

  /// The row with the point of effect k; -1 where it has none.
  Eigen::Index pointRow(std::size_t k) const;
  std::unique_ptr<LinearModel> linearisedAbout(const Eigen::MatrixXd& points) const override;
  std::unique_ptr<ExtendedModel> about(const Eigen::MatrixXd& points) const;
  const Eigen::MatrixXd& currentPoints() const { return points_; }

  /// The input of the plant's linear part: the command after the actuator's effects, filtered by
  /// the additional lags of plant and sensor.
  Signals drivingInput(const Block& block, const Eigen::VectorXd& parameters) const;

  /// Free simulation of the measurement from rest, at the error parameters `xi` of each experiment
  /// (n x M), with its derivatives and random signals.
  Chain simulated(const Block& block, const Eigen::VectorXd& parameters,
                  const Eigen::MatrixXd& xi) const;

  /// Signals of unknown size that an experiment adds to its simulation: the free responses to
  /// initial states (InitialState::estimate) and a constant (Offsets::per_experiment). A row per
  /// sample, a column per signal.
  Eigen::MatrixXd unknownSignals(const Eigen::VectorXd& parameters, int samples) const;

  /// The value, and its derivatives with respect to the parameters listed; the other derivatives
  /// stay empty.
  void evaluate(const Block& block, const Eigen::VectorXd& parameters,
                const std::vector<int>& derivatives, Response* response) const;

 private:
  /// The whitening filter of a block, reused while C and D do not change.
  struct KeptWhitening {
    Eigen::VectorXd c, d;
    std::shared_ptr<const NoiseWhitening> filter;
  };

  std::vector<SetEffect> setEffects(const Eigen::VectorXd& parameters) const;
  Chain value(const Block& block, const Eigen::VectorXd& parameters, KeptWhitening* kept,
              Response* response) const;
  double pointAt(std::size_t k, double size, const Eigen::VectorXd& parameters) const;
  Eigen::MatrixXd pointsFor(const ExtendedModel& other) const;
  Chain chain(const Block& block, const Eigen::VectorXd& parameters) const;
  double step(const Eigen::VectorXd& parameters, int j) const;
  Eigen::Index own() const;
  const EffectParameter* effectParameter(std::size_t k) const;

  Effects effects_;
  DataSummary scales_;
  int experiments_;
  Eigen::MatrixXd points_;
  std::vector<int> offsets_;
  int count_ = 0;  ///< of all parameters
};

/// The model with the effects that a configuration names. Throws ConfigurationError for an effect
/// that does not exist, does not fit the data or does not act in the chain.
std::unique_ptr<ExtendedModel> makeExtendedModel(std::shared_ptr<const NominalModel> nominal,
                                                 const Configuration& configuration,
                                                 const std::vector<Experiment>& experiments);

/// The value of a parameter as results report it, from its value in the model, and back: for a
/// log-variance relative to sigma^2 the standard deviation, for all others the same value.
double toReported(const EffectParameter& parameter, double value, double noise_variance);
double fromReported(const EffectParameter& parameter, double reported, double noise_variance);

/// Names of the parameters of `nominal` on which Go depends, which are the first of theta.
std::vector<std::string> plantParameters(const NominalModel& nominal, const Eigen::VectorXd& theta);

/// Starting values of the effects' parameters, in the model's form: those that the options give,
/// else the first of the catalogue. Throws ConfigurationError for a parameter that an effect lacks.
Eigen::VectorXd startingValues(const Effects& effects, const std::vector<EffectOptions>& options);

}  // namespace uncertainty_identification
