#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "model/statistics.h"
#include "uncertainty_identification/model/block.h"

namespace uncertainty_identification {

/// The whitened signals of a block, or their derivatives to one parameter. A signal without samples
/// stands for zero.
struct WhitenedSignals {
  Signals residual;                 ///< e = H^-1 (y - Go u)
  std::vector<Signals> regressors;  ///< Phi, n signals: e = Phi xi + omega
  /// Z, random effects of each experiment: e = Phi xi + Z zeta + omega. Shared, because one signal
  /// may be the derivative of several columns: its inner products are then computed once. Null
  /// stands for zero.
  std::vector<std::shared_ptr<const Signals>> columns;
  Lanes log_jacobian = Lanes::Zero();
};

/// What a model says of a block at one parameter vector.
struct Response {
  WhitenedSignals value;
  std::vector<WhitenedSignals> derivatives;  ///< to each parameter; empty when not asked for
  /// Precision of each column's coefficient relative to 1/sigma^2: zeta_k ~ N(0,
  /// sigma^2/precision_k); 0 = diffuse (projected out, with -1/2 ln det Z'Z).
  Eigen::VectorXd column_precision;
  std::vector<Eigen::VectorXd> column_precision_derivatives;  ///< per parameter; empty = all zero
  Lanes effective_samples = Lanes::Zero();  ///< measured samples in the likelihood
};

/// The interface that every model implements and that every effect decorates: parameters (theta of
/// the nominal model and whatever a nuisance or effect adds) in; residual, regressors,
/// random-effect columns, log-Jacobian, effective sample counts and their sensitivities out, for a
/// block of experiments at a time. A plain model is the case with nothing extra. Implementations
/// are immutable and may be called from several threads.
class Model {
 public:
  virtual ~Model() = default;

  /// Names of the parameters; their number is p.
  virtual std::vector<std::string> names() const = 0;

  /// Number n of regressors, that is of free error parameters xi.
  virtual int regressors() const = 0;

  /// Fills `response`, with derivatives when asked for.
  virtual void evaluate(const Block& block, const Eigen::VectorXd& parameters, bool derivatives,
                        Response* response) const = 0;

  /// Statistics by a faster way than through evaluate(), where the model has one for this block;
  /// false where not.
  virtual bool fusedStatistics(const Block& /*block*/, const Eigen::VectorXd& /*parameters*/,
                               bool /*derivatives*/, Statistics* /*statistics*/) const {
    return false;
  }

  /// Whether the parameters lie where the likelihood is defined (stable, minimum phase, finite).
  virtual bool admissible(const Eigen::VectorXd& parameters) const = 0;

  /// Unbounded coordinates for an unconstrained optimisation, the way back, and
  /// dparameters/d(unbounded).
  virtual Eigen::VectorXd toUnbounded(const Eigen::VectorXd& parameters) const = 0;
  virtual Eigen::VectorXd fromUnbounded(const Eigen::VectorXd& unbounded) const = 0;
  virtual Eigen::MatrixXd unboundedJacobian(const Eigen::VectorXd& unbounded) const = 0;

  int parameterCount() const { return static_cast<int>(names().size()); }
};

/// Writes the statistics of the block's experiments to their places in `statistics` (whose
/// parameters() says whether derivatives are wanted); leaves the model's response in `response`,
/// empty where the statistics came by a faster way.
void computeStatistics(const Model& model, const Block& block, const Eigen::VectorXd& parameters,
                       Statistics* statistics, Response* response);

}  // namespace uncertainty_identification
