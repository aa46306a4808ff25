#include "estimation/expectation.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

#include "estimation/small_cholesky.h"
#include "math/constants.h"
#include "math/symmetric_eigen.h"

namespace uncertainty_identification {
namespace {

using Eigen::Dynamic;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRounding = 1e-3;  // tolerated per sample, see `lost` below

template <int n>
struct Component {
  double log_weight;
  Column<n> mean;
  Square<n> root;
};

/// The E-step for one experiment and one component; equations in docs/method.md, section on
/// sufficient statistics.
template <int n>
double expect(const Statistics& statistics, int r, const Component<n>& component,
              double noise_variance, Index column, Expectation* out) {
  const Statistics::ConstGram gram = statistics.gram(r);
  const Index size = statistics.regressors();
  const Square<n> S = gram.topLeftCorner(size, size);
  const Column<n> v = gram.topRightCorner(size, 1);
  const double s = gram(size, size);
  const double samples = statistics.samples()[r];

  const Square<n>& L = component.root;
  const Column<n> shifted = S * component.mean;
  const Column<n> r0 = v - shifted;
  const double q0 = s - component.mean.dot(v) - component.mean.dot(r0);
  Square<n> K = L.transpose() * S * L;
  K.diagonal().array() += noise_variance;
  const SmallCholesky<n> factor(K);
  const Column<n> projected = L.transpose() * r0;
  const Column<n> solved = factor.solve(projected);
  const Column<n> mean = component.mean + L * solved;
  const Square<n> covariance = noise_variance * L * factor.solveColumns(Square<n>(L.transpose()));

  double log_determinant = (samples - static_cast<double>(size)) * std::log(noise_variance);
  for (Index k = 0; k < size; ++k) log_determinant += 2 * std::log(factor.diagonal(k));
  const double quadratic = (q0 - projected.dot(solved)) / noise_variance;
  // `quadratic` is a sum of squares. If rounding makes it negative, the likelihood would appear
  // unbounded.
  const bool lost = !factor.succeeded() || quadratic < -kRounding * samples;
  out->means.col(column) = mean;
  Eigen::Map<Square<n>>(out->covariances.col(column).data(), size, size) = covariance;
  const Index kappa = out->misfits.rows();
  out->misfits(column % kappa, column / kappa) =
      s - 2 * v.dot(mean) + mean.dot(S * mean) + S.cwiseProduct(covariance).sum();
  if (lost) return std::numeric_limits<double>::quiet_NaN();
  return component.log_weight - 0.5 * (samples * std::log((2 * kPi)) + log_determinant + quadratic);
}

template <int n>
void expectRange(const Statistics& statistics, const std::vector<Component<n>>& components,
                 double noise_variance, int first, int last, Expectation* out) {
  const Index kappa = static_cast<Index>(components.size());
  for (int r = first; r < last; ++r) {
    auto responsibility = out->responsibilities.col(r);
    for (Index i = 0; i < kappa; ++i) {
      responsibility[i] = expect<n>(statistics, r, components[static_cast<std::size_t>(i)],
                                    noise_variance, r * kappa + i, out);
    }
    const double largest = responsibility.maxCoeff();
    responsibility = (responsibility.array() - largest).exp();
    const double sum = responsibility.sum();
    responsibility /= sum;
    out->log_likelihood[r] = largest + std::log(sum) + statistics.logJacobian()[r];
  }
}

template <int n>
void expectAll(const Statistics& statistics, const Mixture& mixture, double noise_variance,
               WorkerPool* pool, Expectation* out) {
  std::vector<Component<n>> components;
  for (std::size_t i = 0; i < mixture.weights.size(); ++i) {
    components.push_back(
        {std::log(mixture.weights[i]), mixture.means[i], squareRoot(mixture.covariances[i])});
  }
  constexpr int kChunk = 512;
  const int experiments = statistics.experiments();
  pool->forEach((experiments + kChunk - 1) / kChunk, [&](int chunk) {
    expectRange<n>(statistics, components, noise_variance, chunk * kChunk,
                   std::min((chunk + 1) * kChunk, experiments), out);
  });
}

/// Scores of experiment r with respect to the entries of the mixture and log sigma^2.
template <int n>
void scoreMixture(const Statistics& statistics, int r, const ModelParameters& at,
                  const Expectation& expectation, Eigen::Ref<VectorXd> score) {
  const Statistics::ConstGram gram = statistics.gram(r);
  const Index size = statistics.regressors(), p = statistics.parameters();
  const Index kappa = at.mixture.components(), triangle = size * (size + 1) / 2;
  const double variance = at.noise_variance;
  const Square<n> S = gram.topLeftCorner(size, size);
  double misfit = 0;
  for (Index i = 0; i < kappa; ++i) {
    const double z = expectation.responsibilities(i, r);
    const Index column = r * kappa + i;
    const Square<n> posterior =
        Eigen::Map<const Square<n>>(expectation.covariances.col(column).data(), size, size);
    const Column<n> mean = expectation.means.col(column);
    const Column<n> g = (gram.topRightCorner(size, 1) - S * mean) / variance;
    const Square<n> explained = S * posterior * S;
    score[p + i] = z / at.mixture.weights[static_cast<std::size_t>(i)];
    score.segment(p + kappa + i * size, size) = z * g;
    Index entry = p + kappa * (1 + size) + i * triangle;
    for (Index row = 0; row < size; ++row) {
      for (Index col = 0; col <= row; ++col) {
        const double of_covariance =
            0.5 * z * (g[row] * g[col] - (S(row, col) - explained(row, col) / variance) / variance);
        score[entry++] = (row == col ? 1 : 2) * of_covariance;
      }
    }
    misfit += z * expectation.misfits(i, r);
  }
  score[score.size() - 1] = 0.5 * (misfit / variance - statistics.samples()[r]);
}

template <int n>
void scoreAll(const Statistics& statistics, const ModelParameters& at,
              const Expectation& expectation, const LatentMoments& moments, MatrixXd* all) {
  constexpr int kSize = n == Dynamic ? Dynamic : n + 1;
  constexpr int kMost = n == Dynamic ? kMostRegressors + 1 : n + 1;
  using Weight = Eigen::Matrix<double, kSize, kSize, 0, kMost, kMost>;
  const Index size = statistics.regressors();
  Weight weight(size + 1, size + 1);  // dl/dgram: -1/2 sigma^-2 [M -m; -m' 1]
  weight(size, size) = 1;
  for (int r = 0; r < statistics.experiments(); ++r) {
    const auto m = moments.means.col(r);
    const auto P = moments.covariances.col(r);
    for (Index col = 0; col < size; ++col) {
      for (Index row = 0; row < size; ++row)
        weight(row, col) = P[row + col * size] + m[row] * m[col];
      weight(col, size) = weight(size, col) = -m[col];
    }
    for (int j = 0; j < statistics.parameters(); ++j) {
      const Eigen::Map<const Weight> derivative(statistics.gramDerivative(r, j).data(), size + 1,
                                                size + 1);
      (*all)(j, r) = -0.5 / at.noise_variance * derivative.cwiseProduct(weight).sum() +
                     statistics.logJacobianDerivatives()(j, r);
    }
    scoreMixture<n>(statistics, r, at, expectation, all->col(r));
  }
}

}  // namespace

MatrixXd squareRoot(const MatrixXd& covariance) {
  if (covariance.rows() == 1) return covariance.cwiseMax(0).cwiseSqrt();
  const Eigen::LLT<MatrixXd> cholesky(covariance);
  if (cholesky.info() == Eigen::Success) return cholesky.matrixL();
  const SymmetricEigen eigen(covariance);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0).cwiseSqrt().asDiagonal();
}

Expectation expectation(const Statistics& statistics, const Mixture& mixture, double noise_variance,
                        WorkerPool* pool) {
  const Index experiments = statistics.experiments(), n = statistics.regressors();
  const Index kappa = mixture.components();
  Expectation out;
  out.log_likelihood.resize(experiments);
  out.responsibilities.resize(kappa, experiments);
  out.misfits.resize(kappa, experiments);
  out.means.resize(n, kappa * experiments);
  out.covariances.resize(n * n, kappa * experiments);
  switch (n) {
    case 1:
      expectAll<1>(statistics, mixture, noise_variance, pool, &out);
      break;
    case 2:
      expectAll<2>(statistics, mixture, noise_variance, pool, &out);
      break;
    case 3:
      expectAll<3>(statistics, mixture, noise_variance, pool, &out);
      break;
    default:
      expectAll<Dynamic>(statistics, mixture, noise_variance, pool, &out);
  }
  return out;
}

LatentMoments latentMoments(const Expectation& expectation) {
  const Index n = expectation.means.rows(), kappa = expectation.responsibilities.rows();
  const Index experiments = expectation.responsibilities.cols();
  LatentMoments moments{MatrixXd::Zero(n, experiments), MatrixXd::Zero(n * n, experiments)};
  for (Index r = 0; r < experiments; ++r) {
    Eigen::Map<MatrixXd> covariance(moments.covariances.col(r).data(), n, n);
    const auto of_r = expectation.means.middleCols(r * kappa, kappa);
    moments.means.col(r) = of_r * expectation.responsibilities.col(r);
    moments.covariances.col(r) =
        expectation.covariances.middleCols(r * kappa, kappa) * expectation.responsibilities.col(r);
    for (Index i = 0; i < kappa; ++i) {
      const VectorXd away = of_r.col(i) - moments.means.col(r);
      covariance += expectation.responsibilities(i, r) * away * away.transpose();
    }
  }
  return moments;
}

MatrixXd scores(const Statistics& statistics, const ModelParameters& at,
                const Expectation& expectation) {
  const Index n = statistics.regressors(), p = statistics.parameters();
  const Index kappa = at.mixture.components();
  const LatentMoments moments = latentMoments(expectation);
  MatrixXd all(p + kappa * (1 + n + n * (n + 1) / 2) + 1, statistics.experiments());
  switch (n) {
    case 1:
      scoreAll<1>(statistics, at, expectation, moments, &all);
      break;
    case 2:
      scoreAll<2>(statistics, at, expectation, moments, &all);
      break;
    case 3:
      scoreAll<3>(statistics, at, expectation, moments, &all);
      break;
    default:
      scoreAll<Dynamic>(statistics, at, expectation, moments, &all);
  }
  return all;
}

}  // namespace uncertainty_identification
