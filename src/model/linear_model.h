#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/model.h"
#include "uncertainty_identification/model/error_basis.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// Dimension of the space of free responses of Go (1 + GDelta) to past inputs and initial states,
/// for every eta, in a record of `samples`. (theta, xi, eta, Go, GDelta: docs/notation.md.)
int freeResponseDirections(const Polynomials& go, const ErrorBasis& basis, int samples);

/// What a parameter of a linear model belongs to, and its name.
struct ParameterRole {
  enum class Of { nominal_model, input_offset, output_offset, effect };
  Of of = Of::nominal_model;
  std::string name;        ///< e.g. "b1", "offset_y", "width"
  std::string unit;        ///< empty if it follows from the units of u and y
  std::size_t effect = 0;  ///< for Of::effect: index in the configuration's list of effects
  std::string effect_name, effect_variant;  ///< for Of::effect
};

/// A parameter's value as results report it, and the derivative of this value with respect to the
/// model's parameter.
struct ReportedValue {
  double value = 0, derivative = 1;
};

/// The model of the paper, (2) and (13): y = Go (1 + GDelta(eta_r)) u + H omega. In addition it
/// handles what real records contain: an unknown initial state of Go, noise that was present before
/// the first sample, missing outputs, a constant operating point. Parameters: theta of the nominal
/// model, then `offset_y` or `offset_u` if a common offset is estimated.
class LinearModel : public Model {
 public:
  /// Of `options` only those of nuisances are used (initial_state, discard_samples, noise_start,
  /// offsets, offset_side).
  LinearModel(std::shared_ptr<const NominalModel> nominal, const ErrorBasis& basis,
              const EstimationOptions& options);

  const NominalModel& nominal() const { return *nominal_; }
  const ErrorBasis& basis() const { return basis_; }
  Offsets offsets() const { return options_.offsets; }

  std::vector<std::string> names() const override;
  int regressors() const override { return basis_.dimension(); }
  void evaluate(const Block& block, const Eigen::VectorXd& parameters, bool derivatives,
                Response* response) const override;
  std::unique_ptr<const FusedSweep> prepare(const std::vector<Block>& blocks,
                                            const Eigen::VectorXd& parameters,
                                            bool derivatives) const override;
  bool admissible(const Eigen::VectorXd& parameters) const override;
  Eigen::VectorXd toUnbounded(const Eigen::VectorXd& parameters) const override;
  Eigen::VectorXd fromUnbounded(const Eigen::VectorXd& unbounded) const override;
  Eigen::MatrixXd unboundedJacobian(const Eigen::VectorXd& unbounded) const override;

  /// The roles of all parameters, in order.
  virtual std::vector<ParameterRole> roles() const;

  /// Parameter k as results report it, computed from its value in the model.
  virtual ReportedValue reported(std::size_t /*k*/, double value, double /*noise_variance*/) const {
    return {value, 1};
  }
  virtual double fromReported(std::size_t /*k*/, double reported, double /*noise_variance*/) const {
    return reported;
  }

  /// Completes a start of theta and offset by starting values of the effects' parameters: those
  /// given in the configuration, otherwise those of the catalogue.
  virtual Eigen::VectorXd withStartingValues(const Eigen::VectorXd& start,
                                             const std::vector<EffectOptions>& /*effects*/) const {
    return start;
  }

  /// Whether the output is linear in the error parameters xi only near a point, which differs
  /// between experiments.
  virtual bool isLocallyLinear() const { return false; }

  /// The points that correspond to xi_r, given as columns (n x M), at these parameters. Linearising
  /// the model about these points is the next step of the fixed-point iteration. Only if
  /// isLocallyLinear().
  virtual Eigen::MatrixXd points(const Eigen::VectorXd& /*parameters*/,
                                 const Eigen::MatrixXd& /*xi*/) const {
    return {};
  }

  /// The points about which to linearise first: those of xi = 0.
  virtual Eigen::MatrixXd firstPoints(const std::vector<Block>& /*blocks*/,
                                      const Eigen::VectorXd& parameters, int experiments) const {
    return points(parameters, Eigen::MatrixXd::Zero(regressors(), experiments));
  }

  /// The same for experiments in which the data determine the point better than xi does.
  virtual Eigen::MatrixXd pointsOf(const std::vector<Block>& /*blocks*/,
                                   const Eigen::VectorXd& parameters,
                                   const Eigen::MatrixXd& xi) const {
    return points(parameters, xi);
  }

  /// Standard deviation of each row of the points over the experiments, given that of xi (n).
  virtual Eigen::VectorXd pointDeviations(const Eigen::VectorXd& parameters,
                                          double /*noise_variance*/,
                                          const Eigen::VectorXd& of_xi) const {
    return (points(parameters, of_xi) - points(parameters, 0 * of_xi)).cwiseAbs();
  }

  virtual std::unique_ptr<LinearModel> linearisedAbout(const Eigen::MatrixXd& /*points*/) const {
    return nullptr;
  }

  /// Simulates Go u of a block from rest and adds the common offset: the prediction of the nominal
  /// model alone.
  Signals simulate(const Block& block, const Eigen::VectorXd& parameters) const;

 protected:
  /// theta and the common offset (0 if none is estimated) from the vector of all parameters.
  Eigen::VectorXd theta(const Eigen::VectorXd& parameters) const;
  double commonOffset(const Eigen::VectorXd& parameters) const;

  const EstimationOptions& options() const { return options_; }
  const std::shared_ptr<const NominalModel>& sharedNominal() const { return nominal_; }

 private:
  bool hasCommonOffset() const;

  std::shared_ptr<const NominalModel> nominal_;
  ErrorBasis basis_;
  EstimationOptions options_;
};

}  // namespace uncertainty_identification
