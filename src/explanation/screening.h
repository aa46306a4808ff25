#pragma once

#include <vector>

#include "explanation/fit.h"

namespace uncertainty_identification {

/// Predicts what effects would gain on top of a fit at its optimum, without fitting them: a score
/// test. What all candidates share is computed once.
class Screening {
 public:
  Screening(const Fit& base, const FitData& data, const OptimisationOptions& options);

  /// A starting value of an effect with the gain of likelihood [nats] expected from there.
  struct Start {
    Fit fit;  ///< at the start: parameters of base, then psi
    double gain = 0;
    Eigen::VectorXd step;  ///< of the parameters that should bring it; empty where not known
  };

  /// The most promising start of an effect; gain -infinity where there is none.
  Start best(const std::shared_ptr<const Effect>& effect) const;

 private:
  /// What the base says of one block.
  struct BaseBlock {
    const Block* block;
    Response response;
    std::vector<Signals> sensitivities;
    std::vector<const Signals*> list;  ///< whitened Z, Phi, J
    std::vector<Lanes> products;       ///< of the list with itself
  };

  double regressionGain(const ExtendedModel& model, const Eigen::VectorXd& parameters,
                        Eigen::VectorXd* step) const;
  Start startAt(const std::shared_ptr<const ExtendedModel>& model,
                const Eigen::VectorXd& psi) const;

  const Fit& base_;
  const FitData& data_;
  OptimisationOptions options_;
  std::vector<BaseBlock> blocks_;
  Eigen::MatrixXd covariances_;  ///< posterior, of xi, n^2 x M
  double samples_ = 0, base_gain_ = 0, base_jacobian_ = 0;
};

}  // namespace uncertainty_identification
