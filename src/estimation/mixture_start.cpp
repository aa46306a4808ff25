#include <algorithm>
#include <cmath>
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

/// Equal components with these means and a share of the pooled covariance.
Mixture componentsAt(const MatrixXd& means, const MatrixXd& covariance, Constraint constraint) {
  Mixture mixture;
  for (Index i = 0; i < means.cols(); ++i) {
    mixture.weights.push_back(1.0 / static_cast<double>(means.cols()));
    mixture.means.push_back(means.col(i));
    mixture.covariances.push_back(covariance +
                                  1e-9 * MatrixXd::Identity(covariance.rows(), covariance.cols()));
  }
  if (constraint == Constraint::zero_mean) {
    const VectorXd mean = mixture.mean();
    for (VectorXd& of_component : mixture.means) of_component -= mean;
  }
  return mixture;
}

}  // namespace

double smallComponentPenalty(const Mixture& mixture, int experiments) {
  constexpr double kFewest = 2.0, kPenalty = 1e3;
  double penalty = 0;
  for (double weight : mixture.weights) {
    if (weight * experiments < kFewest) penalty += kPenalty;
  }
  return penalty;
}

ModelParameters spreadComponents(const Likelihood& likelihood, const Statistics& statistics,
                                 const ModelParameters& single, int components, int restarts,
                                 std::uint64_t seed, const OptimisationOptions& options,
                                 double* log_likelihood) {
  constexpr int kFirstIterations = 40, kLastIterations = 300;
  constexpr std::size_t kFewestFinalists = 4;
  constexpr double kShares[] = {1.0, 0.2, 0.04};  // overlapping and separate components
  const Expectation of_single = likelihood.expect(statistics, single);
  const MatrixXd points = latentMoments(of_single).means;
  std::mt19937_64 engine(seed);
  std::vector<Finalist> finalists;
  const auto improve = [&](int iterations, double tolerance, Finalist* finalist) {
    const double reached =
        fitMixture(likelihood, statistics, options, iterations, tolerance, &finalist->point);
    finalist->log_likelihood =
        std::isfinite(reached)
            ? reached - smallComponentPenalty(finalist->point.mixture, statistics.experiments())
            : -std::numeric_limits<double>::infinity();
  };
  for (int start = 0; start <= restarts; ++start) {
    if (options.on_iterate &&
        !options.on_iterate({start, likelihood.passes(), of_single.total(), {}}))
      break;
    const MatrixXd means =
        start == 0 ? evenlySpread(points, components) : drawn(points, components, &engine);
    finalists.push_back({single, 0});
    finalists.back().point.mixture = componentsAt(
        means, kShares[start % 3] * single.mixture.covariances.front(), options.constraint);
    improve(kFirstIterations, 1e-3, &finalists.back());
  }
  std::stable_sort(finalists.begin(), finalists.end(), [](const auto& left, const auto& right) {
    return left.log_likelihood > right.log_likelihood;
  });
  finalists.resize(std::min(finalists.size(), std::max(kFewestFinalists, finalists.size() / 4)));
  Finalist best{single, -std::numeric_limits<double>::infinity()};
  for (Finalist& finalist : finalists) {
    improve(kLastIterations, 1e-5, &finalist);
    if (finalist.log_likelihood > best.log_likelihood) best = std::move(finalist);
  }
  *log_likelihood = best.log_likelihood;
  return best.point;
}

}  // namespace uncertainty_identification
