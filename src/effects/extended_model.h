#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/linear_model.h"
#include "model/noise_whitening.h"
#include "uncertainty_identification/effects/effect.h"

namespace uncertainty_identification {

/// An effect with its parameters.
struct SetEffect {
  const Effect* effect;
  Eigen::VectorXd psi;
  Eigen::Index own_point = -1;  ///< row of its point, where it has one
};

/// The linear model extended by effects, in the physical order actuator, plant, sensor, noise.
/// Parameters: those of the linear model, then the effects' in the order given. Nuisances (initial
/// state, offset, missing outputs) as in the linear model. Derivatives by differences of the whole
/// chain: effects compose without knowing of each other.
class ExtendedModel : public LinearModel {
 public:
  /// `scales` chooses the steps of differences; `experiments` is M of the data set that blocks come
  /// from. `points` as of linearisedAbout(); empty: about zero.
  ExtendedModel(std::shared_ptr<const NominalModel> nominal, const ErrorBasis& basis,
                const EstimationOptions& options, Effects effects, const DataSummary& scales,
                int experiments, Eigen::MatrixXd points = {});

  const Effects& effects() const { return effects_; }

  /// Where effect k's parameters begin among all.
  int offsetOf(std::size_t k) const { return offsets_[k]; }
  int effectParameterCount() const { return count_ - static_cast<int>(own()); }
  Eigen::VectorXd psi(const Eigen::VectorXd& parameters, std::size_t k) const;

  /// The same with other effects, of another data set, or linearised about other points.
  std::unique_ptr<ExtendedModel> with(Effects effects) const;
  std::unique_ptr<ExtendedModel> forExperiments(int experiments) const;

  std::vector<std::string> names() const override;
  void evaluate(const Block& block, const Eigen::VectorXd& parameters, bool derivatives,
                Response* response) const override;
  bool fusedStatistics(const Block& block, const Eigen::VectorXd& parameters, bool derivatives,
                       Statistics* statistics) const override;
  bool admissible(const Eigen::VectorXd& parameters) const override;
  Eigen::VectorXd toUnbounded(const Eigen::VectorXd& parameters) const override;
  Eigen::VectorXd fromUnbounded(const Eigen::VectorXd& unbounded) const override;
  Eigen::MatrixXd unboundedJacobian(const Eigen::VectorXd& unbounded) const override;

  /// Most likely coefficients of all columns (of one lane) where Phi xi leaves `unexplained`.
  static Eigen::VectorXd columnCoefficients(const Response& response, const Signals& unexplained,
                                            int lane);

  /// Points are xi (n rows), then a row for each effect with a point of its own, in the order of
  /// effects(). points() keeps those where they stand, pointsOf() takes them from the data.
  bool isLocallyLinear() const override;
  Eigen::MatrixXd points(const Eigen::VectorXd& parameters,
                         const Eigen::MatrixXd& xi) const override;
  Eigen::MatrixXd pointsOf(const std::vector<Block>& blocks, const Eigen::VectorXd& parameters,
                           const Eigen::MatrixXd& xi) const override;
  Eigen::VectorXd pointDeviations(const Eigen::VectorXd& parameters, double noise_variance,
                                  const Eigen::VectorXd& of_xi) const override;

  /// The row of effect k's point; -1 where it has none.
  Eigen::Index pointRow(std::size_t k) const;
  std::unique_ptr<LinearModel> linearisedAbout(const Eigen::MatrixXd& points) const override;
  std::unique_ptr<ExtendedModel> about(const Eigen::MatrixXd& points) const;
  const Eigen::MatrixXd& currentPoints() const { return points_; }

  /// What drives the linear part of the plant, once the actuator's effects and extra lags have
  /// acted.
  Signals drivingInput(const Block& block, const Eigen::VectorXd& parameters) const;

  /// Free simulation of the measurement: what the chain makes of the input at given error
  /// parameters of each experiment (n x M), from rest, with its regressors and random signals.
  Chain simulated(const Block& block, const Eigen::VectorXd& parameters,
                  const Eigen::MatrixXd& xi) const;

  /// What is added to that from an initial state (InitialState::estimate) and an offset of the
  /// experiment's own (Offsets::per_experiment), of sizes unknown: samples x their number.
  Eigen::MatrixXd unknownSignals(const Eigen::VectorXd& parameters, int samples) const;

  /// Value and the derivatives to the parameters listed only; the other derivatives stay empty.
  void evaluate(const Block& block, const Eigen::VectorXd& parameters,
                const std::vector<int>& derivatives, Response* response) const;

 private:
  /// The whitening filter of a block, for as long as C and D stay what they are.
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

  Effects effects_;
  DataSummary scales_;
  int experiments_;
  Eigen::MatrixXd points_;
  std::vector<int> offsets_;
  int count_ = 0;  ///< of all parameters
};

/// The model that a configuration with effects names. Throws ConfigurationError for an effect that
/// does not exist or does not fit the data, or a parameter that it does not have.
std::unique_ptr<ExtendedModel> makeExtendedModel(std::shared_ptr<const NominalModel> nominal,
                                                 const Configuration& configuration,
                                                 const std::vector<Experiment>& experiments);

/// A parameter as results tell it, of the value that the model keeps, and back: the standard
/// deviation in place of a logarithm of a variance relative to sigma^2. All others are told as
/// kept.
double told(const EffectParameter& parameter, double kept, double noise_variance);
double kept(const EffectParameter& parameter, double told, double noise_variance);

/// Names of the parameters of nominal model `nominal` that move Go, the first of theta.
std::vector<std::string> plantParameters(const NominalModel& nominal, const Eigen::VectorXd& theta);

/// Starting values of the effects' parameters as the model keeps them: those that the options give,
/// else the first of the catalogue.
Eigen::VectorXd startingValues(const Effects& effects, const std::vector<EffectOptions>& options);

}  // namespace uncertainty_identification
