#include "explanation/bootstrap.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

#include "estimation/initial_guess.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd normals(Index count, std::mt19937_64* random) {
  std::normal_distribution<double> normal;
  VectorXd values(count);
  for (Index k = 0; k < count; ++k) values[k] = normal(*random);
  return values;
}

/// Sufficient statistics S = Phi'Phi, v = Phi'e and e'e of experiments with the same regressors
/// Phi, drawn from the model: v = S xi + sigma S^(1/2) z, and the part of e'e that the regressors
/// do not explain is sigma^2 times a chi-squared variable.
Statistics simulatedStatistics(const Statistics& of, const ModelParameters& at,
                               std::mt19937_64* random) {
  const int n = of.regressors();
  Statistics drawn = of;
  std::discrete_distribution<std::size_t> component(at.mixture.weights.begin(),
                                                    at.mixture.weights.end());
  const double sigma = std::sqrt(at.noise_variance);
  for (int r = 0; r < of.experiments(); ++r) {
    const std::size_t i = component(*random);
    const VectorXd xi =
        at.mixture.means[i] + squareRoot(at.mixture.covariances[i]) *
                                  normals(squareRoot(at.mixture.covariances[i]).cols(), random);
    const MatrixXd S = of.gram(r).topLeftCorner(n, n);
    const MatrixXd root = squareRoot(S);
    const VectorXd z = normals(root.cols(), random);
    const VectorXd v = S * xi + sigma * root * z;
    const double rest =
        std::chi_squared_distribution<double>(std::max(1.0, of.samples()[r] - n))(*random);
    auto gram = drawn.gram(r);
    gram.topRightCorner(n, 1) = v;
    gram.bottomLeftCorner(1, n) = v.transpose();
    gram(n, n) = xi.dot(S * xi) + 2 * sigma * xi.dot(root * z) +
                 at.noise_variance * (z.squaredNorm() + rest);
  }
  return drawn;
}

/// Highest log-likelihood with so many components, theta fixed.
double reachedWith(const Likelihood& likelihood, const Statistics& statistics,
                   const ModelParameters& single, int components, const FitContext& context) {
  constexpr int kRestarts = 4, kSteps = 200;
  OptimisationOptions options = context.options;
  options.floor = covarianceFloor(single.mixture);
  double reached = 0;
  ModelParameters at = single;
  if (components == 1) return fitMixture(likelihood, statistics, options, kSteps, 1e-3, &at);
  spreadComponents(likelihood, statistics, single, components, kRestarts, context.seed, options,
                   &reached);
  return reached;
}

}  // namespace

bool exceedsSimulatedRatios(const Fit& base, const FitData& data, const FitContext& context,
                            double ratio) {
  constexpr int kSimulations = 60;
  const Likelihood likelihood(*base.model, data.blocks(), data.count(), 1);
  const Statistics statistics = likelihood.statistics(base.at.parameters, false);
  ModelParameters single = base.at;
  single.mixture = {{1.0}, {base.at.mixture.mean()}, {base.at.mixture.covariance()}};
  const int components = base.at.mixture.components();
  std::vector<double> ratios(kSimulations);
  context.pool->forEach(kSimulations, [&](int k) {
    std::seed_seq seed{static_cast<unsigned>(context.seed), static_cast<unsigned>(k)};
    std::mt19937_64 random(seed);
    const Statistics drawn = simulatedStatistics(statistics, base.at, &random);
    ratios[static_cast<std::size_t>(k)] =
        reachedWith(likelihood, drawn, single, components + 1, context) -
        reachedWith(likelihood, drawn, single, components, context);
  });
  for (const double simulated : ratios)
    if (simulated >= ratio) return false;
  return true;
}

}  // namespace uncertainty_identification
