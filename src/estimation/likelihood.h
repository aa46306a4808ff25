#pragma once

#include <memory>
#include <vector>

#include "estimation/expectation.h"
#include "model/model.h"

namespace uncertainty_identification {

/// Information matrices of [parameters; common shift of all means] (p + n), by Gauss-Newton at the
/// latent moments.
struct ScoringInformation {
  Eigen::MatrixXd complete;  ///< sum of d_j'd_k/sigma^2: the curvature of EM's Q, (34)
  Eigen::MatrixXd observed;  ///< less what not knowing xi costs: - (Phi'd_j)' P (Phi'd_k)/sigma^4
};

/// The observed likelihood (16) of a set of experiments under a model, and all that maximising
/// it needs. Counts its sweeps over the samples.
class Likelihood {
 public:
  /// The model and the blocks must outlive this object; `experiments` of them in all.
  Likelihood(const Model& model, const std::vector<Block>& blocks, int experiments, int threads);

  const Model& model() const { return model_; }
  const std::vector<Block>& blocks() const { return blocks_; }
  int experiments() const { return experiments_; }
  WorkerPool* pool() const { return pool_.get(); }

  /// Sweeps over the samples so far.
  int passes() const { return passes_; }

  /// One sweep: the statistics at given model parameters, with their derivatives when asked for.
  Statistics statistics(const Eigen::VectorXd& parameters, bool derivatives) const;

  /// The E-step at given statistics.
  Expectation expect(const Statistics& statistics, const ModelParameters& at) const {
    return expectation(statistics, at.mixture, at.noise_variance, pool_.get());
  }

  /// One sweep: Gauss-Newton information at given latent moments.
  ScoringInformation information(const ModelParameters& at, const LatentMoments& moments) const;

 private:
  const Model& model_;
  const std::vector<Block>& blocks_;
  int experiments_;
  std::unique_ptr<WorkerPool> pool_;
  bool keepsResponses() const;

  mutable int passes_ = 0;
  mutable std::vector<Response> responses_;  ///< of the last statistics() with derivatives
  mutable Eigen::VectorXd responses_at_;     ///< and the parameters they are at
};

}  // namespace uncertainty_identification
