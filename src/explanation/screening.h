#pragma once

#include <vector>

#include "explanation/fit.h"

namespace uncertainty_identification {

/// Predicts what effects would gain on top of a fit at its optimum without fitting them: a score
/// test. theta are the parameters of the base, psi those of an effect, and xi the error parameters
/// of an experiment. What all effects share is computed once, in the constructor.
class Screening {
 public:
  Screening(const Fit& base, const FitData& data, const OptimisationOptions& options);

  /// A start of an effect.
  struct Start {
    Fit fit;               ///< the extended model at the start: parameters of the base, then psi
    double gain = 0;       ///< [nats] of log-likelihood, predicted or found from there
    Eigen::VectorXd step;  ///< of all parameters, that leads to the predicted gain; empty where the
                           ///< gain was not predicted by a step
  };

  /// The start of an effect with the highest gain; -infinity where no start has a likelihood.
  Start best(const std::shared_ptr<const Effect>& effect) const;

 private:
  /// What the base gives for one block.
  struct BaseBlock {
    const Block* block;
    Response response;
    std::vector<Signals> sensitivities;
    std::vector<const Signals*> list;  ///< whitened Z, Phi, J
    std::vector<Lanes> products;       ///< of the list with itself
  };

  /// What a candidate adds to one block.
  struct Candidate {
    double log_jacobian;
    std::vector<Lanes> products;  ///< of the sensitivities to psi, and of the residual r, with the
                                  ///< signals of BaseBlock::list and with each other
    Eigen::Index signals;         ///< number of signals in all
  };

  Candidate evaluate(const ExtendedModel& model, const Eigen::VectorXd& parameters,
                     const BaseBlock& of) const;
  Eigen::MatrixXd marginalGram(const BaseBlock& of, const Candidate& candidate, int lane) const;

  /// Profile log-likelihood [nats] after one Gauss-Newton step of theta, psi and a common shift of
  /// the means of xi; its constant is the same for all candidates. `step` is set to the step of
  /// theta and psi. -infinity where the step is not determined.
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
