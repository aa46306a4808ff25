#include <limits>
#include <random>

#include "estimation/initial_guess.h"

/// Starts of a mixture of several components, out of the experiments' posterior means of xi.
namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// kappa means between the extremes of each coordinate (paper, section 5, step 2).
MatrixXd evenlySpread(const MatrixXd& points, int components) {
  const VectorXd low = points.rowwise().minCoeff(), high = points.rowwise().maxCoeff();
  MatrixXd means(points.rows(), components);
  for (int i = 0; i < components; ++i) {
    means.col(i) =
        low + (high - low) * (components == 1 ? 0.5 : static_cast<double>(i) / (components - 1));
  }
  return means;
}

/// k-means++: each further mean drawn with probability proportional to the squared distance from
/// those drawn.
MatrixXd drawn(const MatrixXd& points, int components, std::mt19937_64* engine) {
  MatrixXd means(points.rows(), components);
  VectorXd distance = VectorXd::Ones(points.cols());
  for (int i = 0; i < components; ++i) {
    double target = std::uniform_real_distribution<double>(0, distance.sum())(*engine);
    Index chosen = 0;
    while (chosen + 1 < points.cols() && target > distance[chosen]) target -= distance[chosen++];
    means.col(i) = points.col(chosen);
    const VectorXd away = (points.colwise() - means.col(i)).colwise().squaredNorm().transpose();
    distance = i == 0 ? away : distance.cwiseMin(away);
  }
  return means;
}

}  // namespace

ModelParameters spreadComponents(const Likelihood& likelihood, const Statistics& statistics,
                                 const ModelParameters& single, int components, int restarts,
                                 std::uint64_t seed, const OptimisationOptions& options,
                                 double* log_likelihood) {
  constexpr int kIterations = 300;
  constexpr double kFewest = 2.0, kPenalty = 1e3;
  const Index n = statistics.regressors();
  const Expectation of_single = likelihood.expect(statistics, single);
  const MatrixXd points = latentMoments(of_single).means;
  const MatrixXd pooled = single.mixture.covariances.front();
  std::mt19937_64 engine(seed);
  ModelParameters best = single;
  double highest = -std::numeric_limits<double>::infinity();
  for (int start = 0; start <= restarts; ++start) {
    const double so_far = std::max(highest, of_single.total());
    if (options.on_iterate && !options.on_iterate({start, likelihood.passes(), so_far, {}})) break;
    const MatrixXd means =
        start == 0 ? evenlySpread(points, components) : drawn(points, components, &engine);
    ModelParameters point = single;
    point.mixture = Mixture();
    for (int i = 0; i < components; ++i) {
      point.mixture.weights.push_back(1.0 / components);
      point.mixture.means.push_back(means.col(i));
      // alternately the whole covariance and a part of it: overlapping and separate components
      point.mixture.covariances.push_back((start % 2 == 0 ? 1.0 : 0.2) * pooled +
                                          1e-9 * MatrixXd::Identity(n, n));
    }
    if (options.constraint == Constraint::zero_mean) {
      const VectorXd mean = point.mixture.mean();
      for (VectorXd& of_component : point.mixture.means) of_component -= mean;
    }
    const double reached = fitMixture(likelihood, statistics, options, kIterations, 1e-5, &point);
    double penalty = 0;
    for (double weight : point.mixture.weights) {
      if (weight * static_cast<double>(points.cols()) < kFewest) penalty += kPenalty;
    }
    if (reached - penalty > highest) {
      highest = reached - penalty;
      best = point;
    }
  }
  *log_likelihood = highest;
  return best;
}

}  // namespace uncertainty_identification
