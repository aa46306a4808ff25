#pragma once

#include <memory>
#include <vector>

#include "effects/extended_model.h"
#include "estimation/optimisation.h"

namespace uncertainty_identification {

// theta are the parameters of the linear model, psi those of the effects that extend it, and xi the
// error parameters of an experiment (docs/notation.md).

/// A model with effects, a point of its parameters, and what follows from them for some
/// experiments.
struct Fit {
  std::shared_ptr<const ExtendedModel> model;
  ModelParameters at;
  double log_likelihood = 0;       ///< -infinity where the model cannot be evaluated
  Eigen::VectorXd of_experiments;  ///< log-likelihood of each experiment (M)
  Eigen::MatrixXd xi;              ///< posterior means of the error parameters, n x M
};

/// Residuals at the posterior means, e - Phi xi - Z zeta, divided by sigma.
struct Residuals {
  std::vector<Signals> standardised;  ///< one per block; 0 where nothing was measured
  Eigen::MatrixXd coefficients;       ///< zeta of the random signals and nuisances (columns x M)
};

/// Experiments, and the blocks that the model is evaluated on.
class FitData {
 public:
  explicit FitData(std::vector<Experiment> experiments);

  const std::vector<Experiment>& experiments() const { return *experiments_; }
  const std::vector<Block>& blocks() const { return blocks_; }
  int count() const { return static_cast<int>(experiments_->size()); }
  double samples() const;  ///< measured, of all experiments

 private:
  std::shared_ptr<const std::vector<Experiment>> experiments_;
  std::vector<Block> blocks_;
};

/// The model at a point. The log-likelihood is -infinity where the parameters are not admissible or
/// the likelihood is not finite.
Fit evaluated(std::shared_ptr<const ExtendedModel> model, const ModelParameters& at,
              const FitData& data);

/// The model with the mixture and the noise variance optimised, starting at `at`, and theta and psi
/// fixed.
Fit mixtureFitted(std::shared_ptr<const ExtendedModel> model, const ModelParameters& at,
                  const FitData& data, const OptimisationOptions& options, int iterations);

Residuals residualsOf(const Fit& fit, const FitData& data);

/// One step of a fixed-point iteration: the model linearised about the fit's posterior means of xi
/// (and of clock shifts), evaluated at the same parameters. Returns the fit itself where the model
/// is linear in xi.
Fit relinearised(const Fit& fit, const FitData& data);

/// Takes up to `steps` scoring steps, each with an update of the mixture, and ends when one gains
/// less than `tolerance` [nats]. A model that is not linear in xi is linearised again after every
/// second step. Returns the best point found.
Fit takeScoringSteps(Fit fit, const FitData& data, const OptimisationOptions& options, int steps,
                     double tolerance);

/// The parameters of a fit evaluated on other experiments. A model that is not linear in xi is
/// linearised about the posterior means that these experiments give.
Fit evaluateOn(const Fit& fit, const FitData& data);

}  // namespace uncertainty_identification
