#pragma once

#include <memory>
#include <vector>

#include "estimation/expectation.h"
#include "model/model.h"

namespace uncertainty_identification {

/// Gauss-Newton information matrices of [parameters; common shift of all means], of size p + n, at
/// the latent moments of xi.
struct ScoringInformation {
  Eigen::MatrixXd complete;  ///< sum of d_j'd_k/sigma^2, d_j the residual's derivatives: the
                             ///< curvature of EM's Q, (34)
  Eigen::MatrixXd observed;  ///< `complete` minus the information lost because xi is unknown:
                             ///< (Phi'd_j)' P (Phi'd_k)/sigma^4
};

/// The observed likelihood (16) of experiments under a model, with the derivatives that maximising
/// it needs. Counts the sweeps over the samples.
class Likelihood {
 public:
  /// The model and the blocks must outlive this object. `experiments` is the number of experiments
  /// in all blocks.
  Likelihood(const Model& model, const std::vector<Block>& blocks, int experiments, int threads);

  const Model& model() const { return model_; }
  const std::vector<Block>& blocks() const { return blocks_; }
  int experiments() const { return experiments_; }
  WorkerPool* pool() const { return pool_.get(); }

  /// Number of sweeps over the samples so far.
  int passes() const { return passes_; }

  /// Computes the statistics at given model parameters, with derivatives if requested. One sweep.
  Statistics statistics(const Eigen::VectorXd& parameters, bool derivatives) const;

  /// The E-step, from given statistics.
  Expectation expect(const Statistics& statistics, const ModelParameters& at) const {
    return expectation(statistics, at.mixture, at.noise_variance, pool_.get());
  }

  /// Gauss-Newton information at given moments of xi. One sweep.
  ScoringInformation information(const ModelParameters& at, const LatentMoments& moments) const;

 private:
  const Model& model_;
  const std::vector<Block>& blocks_;
  int experiments_;
  std::unique_ptr<WorkerPool> pool_;
  bool keepsResponses() const;

  mutable int passes_ = 0;
  mutable std::vector<Response>
      responses_;                         ///< responses at the last statistics() with derivatives
  mutable Eigen::VectorXd responses_at_;  ///< the parameters of these responses
};

}  // namespace uncertainty_identification
