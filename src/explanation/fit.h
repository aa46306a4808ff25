#pragma once

#include <memory>
#include <vector>

#include "effects/extended_model.h"
#include "estimation/optimisation.h"

namespace uncertainty_identification {

/// An extended model with parameters, and what it says of the experiments it is for.
struct Fit {
  std::shared_ptr<const ExtendedModel> model;
  ModelParameters at;
  double log_likelihood = 0;
  Eigen::VectorXd of_experiments;  ///< log-likelihood of each
  Eigen::MatrixXd xi;              ///< posterior means of the error parameters, n x M
};

/// What is left of the data: e - Phi m - Z zeta, divided by sigma, 0 where nothing was measured;
/// per block.
struct Residuals {
  std::vector<Signals> standardised;
  Eigen::MatrixXd coefficients;  ///< zeta of the random signals and nuisances (columns x M)
};

/// Experiments that models are fitted to or judged by.
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

/// The model at given parameters. Not finite, or not admissible: log-likelihood -infinity.
Fit evaluated(std::shared_ptr<const ExtendedModel> model, const ModelParameters& at,
              const FitData& data);

/// The same with the mixture and the noise variance fitted to it, theta and psi as they are.
Fit mixtureFitted(std::shared_ptr<const ExtendedModel> model, const ModelParameters& at,
                  const FitData& data, const OptimisationOptions& options, int iterations);

Residuals residualsOf(const Fit& fit, const FitData& data);

/// The model about the posterior means (and clock shifts) of a fit; the same fit where the model is
/// linear everywhere.
Fit relinearised(const Fit& fit, const FitData& data);

/// Up to `steps` joint scoring steps with mixture updates, linearised anew after each two where the
/// model is linear only locally; ends when one gains less than `tolerance` [nats].
Fit takeScoringSteps(Fit fit, const FitData& data, const OptimisationOptions& options, int steps,
                     double tolerance);

/// A fit of an experiment set that was not fitted to: points found for each experiment.
Fit evaluateOn(const Fit& fit, const FitData& data);

}  // namespace uncertainty_identification
