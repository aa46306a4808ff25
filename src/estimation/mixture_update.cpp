#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "estimation/optimisation.h"
#include "math/symmetric_eigen.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// For each component: the sum of responsibilities n_i and the weighted mean of the posterior means
/// of xi.
struct ComponentSums {
  VectorXd counts;
  MatrixXd means;  ///< n x kappa
};

ComponentSums componentSums(const Expectation& e) {
  const Index kappa = e.responsibilities.rows(), n = e.means.rows();
  ComponentSums sums{e.responsibilities.rowwise().sum(), MatrixXd::Zero(n, kappa)};
  for (Index r = 0; r < e.responsibilities.cols(); ++r) {
    for (Index i = 0; i < kappa; ++i)
      sums.means.col(i) += e.responsibilities(i, r) * e.means.col(r * kappa + i);
  }
  for (Index i = 0; i < kappa; ++i) sums.means.col(i) /= std::max(sums.counts[i], 1e-300);
  return sums;
}

/// Weights and means that maximise Q subject to sum_i alpha_i mu_i = 0, for a given Lagrange
/// multiplier lambda: alpha_i = n_i c_i, mu_i = xibar_i - c_i Gamma_i lambda, c_i = 1/(M +
/// lambda'mu_i). This is a quadratic equation for c_i; the solution with c_i = 1/M at lambda = 0 is
/// taken.
struct ZeroMean {
  const ComponentSums& sums;
  const std::vector<MatrixXd>& covariances;
  double experiments;

  /// Returns false if lambda is outside the domain.
  bool at(const VectorXd& lambda, VectorXd* weights, MatrixXd* means) const {
    for (Index i = 0; i < weights->size(); ++i) {
      const VectorXd direction = covariances[static_cast<std::size_t>(i)] * lambda;
      const double linear = experiments + lambda.dot(sums.means.col(i));
      const double discriminant = linear * linear - 4 * lambda.dot(direction);
      if (!(linear > 0) || !(discriminant >= 0)) return false;
      const double c = 2 / (linear + std::sqrt(discriminant));
      (*weights)[i] = sums.counts[i] * c;
      means->col(i) = sums.means.col(i) - c * direction;
    }
    return true;
  }

  /// Finds the lambda with zero mean by Newton's method. Returns false if it does not converge.
  bool solve(VectorXd* weights, MatrixXd* means) const {
    const Index n = means->rows();
    VectorXd lambda = VectorXd::Zero(n);
    if (!at(lambda, weights, means)) return false;
    VectorXd mean = meanOf(*weights, *means);
    const double scale = 1e-14 + means->cwiseAbs().maxCoeff();
    for (int iteration = 0; iteration < 50 && mean.cwiseAbs().maxCoeff() > 1e-13 * scale;
         ++iteration) {
      MatrixXd jacobian(n, n);
      const double step = 1e-6 * experiments / scale;
      VectorXd w = *weights;
      MatrixXd m = *means;
      for (Index k = 0; k < n; ++k) {
        if (!at(lambda + step * VectorXd::Unit(n, k), &w, &m)) return false;
        jacobian.col(k) = (meanOf(w, m) - mean) / step;
      }
      const VectorXd direction = -jacobian.fullPivLu().solve(mean);
      if (!direction.allFinite() || !improve(direction, &lambda, &mean, weights, means)) break;
    }
    return mean.cwiseAbs().maxCoeff() <= 1e-10 * scale && std::abs(weights->sum() - 1) < 1e-8;
  }

 private:
  /// The mean is divided by the sum of the weights, because sum_i alpha_i mu_i also becomes small
  /// if all weights do, far from a solution. At a solution the weights sum to 1.
  static VectorXd meanOf(const VectorXd& weights, const MatrixXd& means) {
    return means * weights / weights.sum();
  }

  bool improve(const VectorXd& direction, VectorXd* lambda, VectorXd* mean, VectorXd* weights,
               MatrixXd* means) const {
    VectorXd w = *weights;
    MatrixXd m = *means;
    for (double fraction = 1; fraction > 1e-6; fraction /= 2) {
      if (!at(*lambda + fraction * direction, &w, &m)) continue;
      const VectorXd there = meanOf(w, m);
      if (there.norm() >= mean->norm()) continue;
      *lambda += fraction * direction;
      *mean = there;
      *weights = w;
      *means = m;
      return true;
    }
    return false;
  }
};

/// The covariance with the largest likelihood among those whose eigenvalues relative to the floor
/// are at least 1.
MatrixXd floored(const MatrixXd& covariance, const MatrixXd& floor) {
  if (floor.size() == 0 || floor.isZero(0)) return covariance;
  const SymmetricEigen eigen(covariance, floor);
  if (!eigen.converged() || eigen.eigenvalues().minCoeff() >= 1) return covariance;
  const MatrixXd basis =
      floor * eigen.eigenvectors();  // covariance = basis diag(eigenvalues) basis'
  return basis * eigen.eigenvalues().cwiseMax(1.0).asDiagonal() * basis.transpose();
}

}  // namespace

void updateMixture(const Statistics& statistics, const Expectation& e,
                   const OptimisationOptions& options, ModelParameters* at) {
  const Index kappa = e.responsibilities.rows(), n = e.means.rows();
  const double experiments = static_cast<double>(e.responsibilities.cols());
  at->noise_variance =
      e.responsibilities.cwiseProduct(e.misfits).sum() / statistics.samples().sum();  // (29)
  if (n == 0) return;

  const ComponentSums sums = componentSums(e);
  VectorXd weights = sums.counts / experiments;  // (26)
  MatrixXd means = sums.means;                   // (27)
  if (options.constraint == Constraint::zero_mean) {
    if (kappa == 1) {
      weights[0] = 1;
      means.setZero();
    } else if (!ZeroMean{sums, at->mixture.covariances, experiments}.solve(&weights, &means)) {
      // Keep the weights and means, which satisfy the constraint. Updating the covariances alone
      // still increases the likelihood.
      for (Index i = 0; i < kappa; ++i) {
        weights[i] = at->mixture.weights[static_cast<std::size_t>(i)];
        means.col(i) = at->mixture.means[static_cast<std::size_t>(i)];
      }
    }
  }
  for (Index i = 0; i < kappa; ++i) {
    MatrixXd covariance = MatrixXd::Zero(n, n);  // (28), with the updated mean
    for (Index r = 0; r < e.responsibilities.cols(); ++r) {
      const VectorXd away = e.means.col(r * kappa + i) - means.col(i);
      covariance += e.responsibilities(i, r) *
                    (away * away.transpose() +
                     Eigen::Map<const MatrixXd>(e.covariances.col(r * kappa + i).data(), n, n));
    }
    const auto component = static_cast<std::size_t>(i);
    at->mixture.weights[component] = weights[i];
    at->mixture.means[component] = means.col(i);
    at->mixture.covariances[component] =
        floored(covariance / std::max(sums.counts[i], 1e-300), options.floor);
  }
}

double fitMixture(const Likelihood& likelihood, const Statistics& statistics,
                  const OptimisationOptions& options, int iterations, double tolerance,
                  ModelParameters* at) {
  double last = -std::numeric_limits<double>::infinity();
  for (int iteration = 0; iteration < iterations; ++iteration) {
    const Expectation e = likelihood.expect(statistics, *at);
    const double now = e.total();
    if (now - last < tolerance) return now;
    last = now;
    updateMixture(statistics, e, options, at);
  }
  return likelihood.expect(statistics, *at).total();
}

bool pruneComponents(Constraint constraint, Mixture* mixture) {
  const double limit = 1.0 / (100.0 * mixture->components());
  Mixture kept;
  double sum = 0;
  for (std::size_t i = 0; i < mixture->weights.size(); ++i) {
    if (mixture->weights[i] < limit) continue;
    kept.weights.push_back(mixture->weights[i]);
    kept.means.push_back(mixture->means[i]);
    kept.covariances.push_back(mixture->covariances[i]);
    sum += mixture->weights[i];
  }
  if (kept.components() == mixture->components()) return false;
  for (double& weight : kept.weights) weight /= sum;
  if (constraint == Constraint::zero_mean) {
    const VectorXd mean = kept.mean();
    for (VectorXd& of_component : kept.means) of_component -= mean;
  }
  *mixture = std::move(kept);
  return true;
}

MatrixXd covarianceFloor(const Mixture& start) {
  const MatrixXd pooled = start.covariance();
  MatrixXd floor = 1e-4 * pooled;
  // Also a direction without any spread needs a positive floor.
  if (floor.size() > 0) floor.diagonal().array() += 1e-12 * std::max(pooled.trace(), 1e-12);
  return floor;
}

}  // namespace uncertainty_identification
