#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/model.h"
#include "uncertainty_identification/model/error_basis.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// Number of directions that unknown past inputs and the initial state of Go (1 + GDelta) span,
/// whatever eta, in a record of `samples`.
int freeResponseDirections(const Polynomials& go, const ErrorBasis& basis, int samples);

/// What a parameter of a linear model belongs to, and its name there.
struct ParameterRole {
  enum class Of { nominal_model, input_offset, output_offset, effect };
  Of of = Of::nominal_model;
  std::string name;        ///< e.g. "b1", "offset_y", "width"
  std::string unit;        ///< empty where it follows from the units of u and y
  std::size_t effect = 0;  ///< Of::effect only: its place among the configuration's effects
  std::string effect_name, effect_variant;  ///< likewise
};

/// A parameter's value in the form that results report, and its derivative to the model's value.
struct ReportedValue {
  double value = 0, derivative = 1;
};

/// The paper's model (2), (13): y = Go (1 + GDelta(eta_r)) u + H omega with the nuisances of real
/// records, an unknown initial state of Go, noise that was running before the first sample, missing
/// outputs, an operating point. Parameters: theta of the nominal model, then `offset_y` or
/// `offset_u` where a common offset is estimated.
class LinearModel : public Model {
 public:
  /// Only the nuisance options of `options` are used (initial_state, discard_samples, noise_start,
  /// offsets, offset_side).
  LinearModel(std::shared_ptr<const NominalModel> nominal, const ErrorBasis& basis,
              const EstimationOptions& options);

  const NominalModel& nominal() const { return *nominal_; }
  const ErrorBasis& basis() const { return basis_; }

  std::vector<std::string> names() const override;
  int regressors() const override { return basis_.dimension(); }
  void evaluate(const Block& block, const Eigen::VectorXd& parameters, bool derivatives,
                Response* response) const override;
  bool fusedStatistics(const Block& block, const Eigen::VectorXd& parameters, bool derivatives,
                       Statistics* statistics) const override;
  bool admissible(const Eigen::VectorXd& parameters) const override;
  Eigen::VectorXd toUnbounded(const Eigen::VectorXd& parameters) const override;
  Eigen::VectorXd fromUnbounded(const Eigen::VectorXd& unbounded) const override;
  Eigen::MatrixXd unboundedJacobian(const Eigen::VectorXd& unbounded) const override;

  /// The role of each parameter.
  virtual std::vector<ParameterRole> roles() const;

  /// Parameter k as results report it, from its value in the model, and back.
  virtual ReportedValue reported(std::size_t /*k*/, double value, double /*noise_variance*/) const {
    return {value, 1};
  }
  virtual double fromReported(std::size_t /*k*/, double reported, double /*noise_variance*/) const {
    return reported;
  }

  /// A start of theta and the offset, completed by starting values of what extends the model: those
  /// that the configuration's effects give, else those of the catalogue.
  virtual Eigen::VectorXd withStartingValues(const Eigen::VectorXd& start,
                                             const std::vector<EffectOptions>& /*effects*/) const {
    return start;
  }

  /// Whether the output is linear in the error parameters xi only near a point for each experiment.
  virtual bool isLocallyLinear() const { return false; }

  /// The points that belong to xi_r, given as columns (n x M), at these parameters; the same model
  /// linearised about points is the next step of an iterated linearisation. Both only where
  /// isLocallyLinear().
  virtual Eigen::MatrixXd points(const Eigen::VectorXd& /*parameters*/,
                                 const Eigen::MatrixXd& /*xi*/) const {
    return {};
  }

  /// The same for experiments whose measurements tell more of the point than xi, all else as here.
  virtual Eigen::MatrixXd pointsOf(const std::vector<Block>& /*blocks*/,
                                   const Eigen::VectorXd& parameters,
                                   const Eigen::MatrixXd& xi) const {
    return points(parameters, xi);
  }

  /// How far apart experiments lie: the standard deviation of each row of their points, given that
  /// of xi (n).
  virtual Eigen::VectorXd pointDeviations(const Eigen::VectorXd& parameters,
                                          double /*noise_variance*/,
                                          const Eigen::VectorXd& of_xi) const {
    return (points(parameters, of_xi) - points(parameters, 0 * of_xi)).cwiseAbs();
  }

  virtual std::unique_ptr<LinearModel> linearisedAbout(const Eigen::MatrixXd& /*points*/) const {
    return nullptr;
  }

  /// Free simulation Go u of one block (plus the offset), from rest: what the nominal model alone
  /// predicts.
  Signals simulate(const Block& block, const Eigen::VectorXd& parameters) const;

 protected:
  /// Theta and the common offset (0 where none is estimated) among all parameters.
  Eigen::VectorXd theta(const Eigen::VectorXd& parameters) const;
  double commonOffset(const Eigen::VectorXd& parameters) const;

  const EstimationOptions& options() const { return options_; }
  const std::shared_ptr<const NominalModel>& sharedNominal() const { return nominal_; }

 private:
  bool hasCommonOffset() const { return options_.offsets == Offsets::estimate; }

  std::shared_ptr<const NominalModel> nominal_;
  ErrorBasis basis_;
  EstimationOptions options_;
};

}  // namespace uncertainty_identification
