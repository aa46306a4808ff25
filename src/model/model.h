#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "model/statistics.h"
#include "uncertainty_identification/model/block.h"

namespace uncertainty_identification {

/// The whitened signals of a block, or their derivatives with respect to one parameter. An empty
/// signal stands for zero.
struct WhitenedSignals {
  Signals residual;                 ///< e = H^-1 (y - Go u)
  std::vector<Signals> regressors;  ///< Phi, n signals: e = Phi xi + omega
  /// Z, the random-effect columns of each experiment: e = Phi xi + Z zeta + omega. Shared, because
  /// one signal may be the derivative of several columns and its inner products are then computed
  /// once. Null stands for zero; a column may end before the last sample, and is zero from there
  /// on.
  std::vector<std::shared_ptr<const Signals>> columns;
  Lanes log_jacobian = Lanes::Zero();
};

/// The response of a model for one block at given parameters.
struct Response {
  WhitenedSignals value;
  std::vector<WhitenedSignals>
      derivatives;  ///< with respect to each parameter; empty if not requested
  /// Precision of each column's coefficient relative to 1/sigma^2: zeta_k ~ N(0,
  /// sigma^2/precision_k). 0 means a flat prior: the column is projected out, with log-Jacobian
  /// -1/2 ln det Z'Z.
  Eigen::VectorXd column_precision;
  std::vector<Eigen::VectorXd> column_precision_derivatives;  ///< per parameter; empty = all zero
  Lanes effective_samples = Lanes::Zero();  ///< measured samples that count in the likelihood
};

/// A model at given parameters, prepared to compute the statistics of blocks without evaluate().
/// Immutable; may be called from several threads.
class FusedSweep {
 public:
  virtual ~FusedSweep() = default;

  /// Computes the statistics of the experiments in a block, with derivatives if these were asked
  /// for. Returns false if this block needs the general path.
  virtual bool statistics(const Block& block, Statistics* statistics) const = 0;

  /// The same for what a scoring step needs of each lane: the Gram matrix of [Phi d], with
  /// random-effect columns integrated out. d are the derivatives of e - Phi m - Z zeta with respect
  /// to the parameters, m the means of xi (n x M), zeta the most likely coefficients.
  virtual bool sensitivities(const Block& block, const Eigen::MatrixXd& means,
                             std::vector<Eigen::MatrixXd>* products) const = 0;
};

/// The interface of all models. Input: parameters (theta of the nominal model, and those of
/// nuisances and effects). Output for a block of experiments: residual, regressors, random-effect
/// columns, log-Jacobian, number of effective samples, and their derivatives. An effect is a model
/// that wraps another one. Implementations are immutable and may be called from several threads.
/// (Notation: docs/notation.md.)
class Model {
 public:
  virtual ~Model() = default;

  /// Names of the parameters; their number is p.
  virtual std::vector<std::string> names() const = 0;

  /// Number n of regressors, which equals the number of free error parameters xi.
  virtual int regressors() const = 0;

  /// Computes the response, with derivatives if requested.
  virtual void evaluate(const Block& block, const Eigen::VectorXd& parameters, bool derivatives,
                        Response* response) const = 0;

  /// Prepares a faster method for the statistics of these blocks, which must outlive the result, or
  /// returns null if the model has none.
  virtual std::unique_ptr<const FusedSweep> prepare(const std::vector<Block>& /*blocks*/,
                                                    const Eigen::VectorXd& /*parameters*/,
                                                    bool /*derivatives*/) const {
    return nullptr;
  }

  /// Whether the likelihood is defined at these parameters (stable, minimum phase, finite).
  virtual bool admissible(const Eigen::VectorXd& parameters) const = 0;

  /// Unbounded coordinates for an unconstrained optimisation, their inverse, and
  /// dparameters/d(unbounded).
  virtual Eigen::VectorXd toUnbounded(const Eigen::VectorXd& parameters) const = 0;
  virtual Eigen::VectorXd fromUnbounded(const Eigen::VectorXd& unbounded) const = 0;
  virtual Eigen::MatrixXd unboundedJacobian(const Eigen::VectorXd& unbounded) const = 0;

  int parameterCount() const { return static_cast<int>(names().size()); }
};

/// Computes the statistics of the experiments in a block by the general path and stores them in
/// `statistics`; statistics->parameters() tells whether derivatives are needed. Leaves the model's
/// response in `response`.
void computeStatistics(const Model& model, const Block& block, const Eigen::VectorXd& parameters,
                       Statistics* statistics, Response* response);

}  // namespace uncertainty_identification
