#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <vector>

#include "estimation/likelihood.h"
#include "estimation/optimisation.h"
#include "model/linear_model.h"
#include "support/golden.h"
#include "support/random_system.h"
#include "uncertainty_identification/configuration.h"

/// Helpers for tests of models and likelihoods with a random system or golden data.
namespace uncertainty_identification::test {

/// A model, experiments and their likelihood.
class CoreSetup {
 public:
  CoreSetup(const Configuration& configuration, std::vector<Experiment> experiments,
            int threads = 1);

  const LinearModel& model() const { return *model_; }
  const std::vector<Block>& blocks() const { return blocks_; }
  const std::vector<Experiment>& experiments() const { return experiments_; }
  const Likelihood& likelihood() const { return *likelihood_; }

  /// E-step at these parameters, one sweep.
  Expectation expect(const ModelParameters& at) const;

  /// Observed log-likelihood (16), one sweep.
  double logLikelihood(const ModelParameters& at) const { return expect(at).total(); }

 private:
  std::vector<Experiment> experiments_;
  std::vector<Block> blocks_;
  std::unique_ptr<LinearModel> model_;
  std::unique_ptr<Likelihood> likelihood_;
};

/// A configuration of the paper's model: Box-Jenkins of these orders, everything at rest before the
/// first sample, no offsets, one thread.
Configuration atRest(int nb, int na, int nc, int nd, int delay);

/// atRest() with the orders and the error model of a random system.
Configuration configurationOf(const RandomSystemOptions& options);

/// atRest() with the orders and the T of golden data.
Configuration configurationOf(const Golden& golden);

/// theta = [b; a; c; d], mixture and noise variance; without an error model a mixture of one
/// component over no parameters. A common offset is to be appended.
ModelParameters parametersOf(const dense::Model& model);
ModelParameters parametersOf(const GoldenPoint& point);

/// `parameters` with one entry more.
Eigen::VectorXd appended(const Eigen::VectorXd& parameters, double value);

/// Options of an optimisation from `start`, with the covariance floor that goes with it.
OptimisationOptions optimisationOptions(const Configuration& configuration, const Mixture& start,
                                        double tolerance);

using VectorFunction = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

/// Jacobian by central differences extrapolated to zero step (Richardson), steps relative to
/// max(|x_j|, 0.1).
Eigen::MatrixXd differences(const VectorFunction& function, const Eigen::VectorXd& at,
                            double relative_step = 1e-3);

/// [parameters; weights; means; covariances; log sigma^2], the coordinates of scores(), and
/// back to parameters of the sizes of `sizes`. Weights need not sum to 1.
Eigen::VectorXd naturalCoordinates(const ModelParameters& at);
ModelParameters fromNaturalCoordinates(const Eigen::VectorXd& coordinates,
                                       const ModelParameters& sizes);

/// The paper's Example 1, (36) and (37): M = N = 100, a mixture of two components, at rest.
RandomSystem example1(std::uint64_t seed, int experiments = 100);

/// Its configuration with two components.
Configuration example1Configuration();

/// An explicit list as a vector.
Eigen::VectorXd vectorOf(std::initializer_list<double> values);

std::vector<const Experiment*> pointersTo(const std::vector<Experiment>& experiments);

}  // namespace uncertainty_identification::test
