#include "own_simulation/correlated_regression.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "math/constants.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

int cosineCount(Index samples) {
  constexpr int kFewest = 6, kMost = 32;
  const double wanted = std::min<double>(std::sqrt(static_cast<double>(samples)) / 2, kMost);
  return std::max(static_cast<int>(wanted), kFewest);
}

/// cos(pi k (t + 1/2) / N) for t = 0 .. N - 1.
VectorXd cosineOf(int k, Index samples) {
  const double half = 0.5 * kPi * k / static_cast<double>(samples);
  return VectorXd::LinSpaced(samples, half, kPi * k - half).array().cos();
}

/// Columns of unit length, so that their products are well conditioned.
struct Scaled {
  explicit Scaled(const MatrixXd& columns)
      : size(columns.colwise().norm()),
        columns(columns * size.cwiseInverse().asDiagonal()),
        gram(this->columns.transpose() * this->columns) {}

  VectorXd solve(const VectorXd& y) const { return gram.solve(columns.transpose() * y); }

  VectorXd size;
  MatrixXd columns;
  Eigen::LDLT<MatrixXd> gram;
};

/// What the variance of one coefficient w'y, w [N], is made of.
struct Projections {
  VectorXd of_residual;  // nu: sum over t of w cosine residual
  MatrixXd of_columns;   // n x nu: the same with the columns in place of the residual
  VectorXd of_weights;   // 2 nu + 1: sum of w^2 cosine, from frequency 0
};

Projections projections(const VectorXd& weights, const MatrixXd& columns, const VectorXd& residual,
                        int cosines) {
  Projections all{VectorXd(cosines), MatrixXd(columns.cols(), cosines), VectorXd(2 * cosines + 1)};
  const VectorXd squares = weights.cwiseAbs2();
  all.of_weights[0] = squares.sum();
  for (int k = 1; k <= 2 * cosines; ++k) {
    const VectorXd cosine = cosineOf(k, weights.size());
    all.of_weights[k] = squares.dot(cosine);
    if (k > cosines) continue;
    const VectorXd turned = weights.cwiseProduct(cosine);
    all.of_residual[k - 1] = turned.dot(residual);
    all.of_columns.col(k - 1) = columns.transpose() * turned;
  }
  return all;
}

/// Covariance of `of_residual` where the noise is white with variance 1.
MatrixXd covarianceOfWhite(const Projections& all, const Eigen::LDLT<MatrixXd>& gram) {
  const Index cosines = all.of_residual.size();
  MatrixXd covariance = -all.of_columns.transpose() * gram.solve(all.of_columns);
  for (Index i = 0; i < cosines; ++i)
    for (Index j = 0; j < cosines; ++j)
      covariance(i, j) += (all.of_weights[std::abs(i - j)] + all.of_weights[i + j + 2]) / 2;
  return covariance;
}

}  // namespace

VectorXd leastSquares(const MatrixXd& columns, const VectorXd& y) {
  const Scaled scaled(columns);
  return scaled.solve(y).cwiseQuotient(scaled.size);
}

Regression regress(const MatrixXd& columns, const VectorXd& y) {
  const Scaled scaled(columns);
  const VectorXd found = scaled.solve(y), residual = y - scaled.columns * found;
  const Index n = columns.cols();
  Regression regression{found.cwiseQuotient(scaled.size), VectorXd(n), VectorXd(n)};
  for (Index i = 0; i < n; ++i) {
    const VectorXd weights = scaled.columns * scaled.gram.solve(VectorXd::Unit(n, i));
    const Projections all = projections(weights, scaled.columns, residual, cosineCount(y.size()));
    const MatrixXd white = covarianceOfWhite(all, scaled.gram);
    const double scale = all.of_weights[0] / white.trace();
    regression.variances[i] =
        scale * all.of_residual.squaredNorm() / (scaled.size[i] * scaled.size[i]);
    regression.degrees[i] = white.trace() * white.trace() / white.squaredNorm();
  }
  return regression;
}

double independentShare(const MatrixXd& columns) {
  if (!(columns.colwise().norm().minCoeff() > 0)) return 0;
  const Scaled others(columns.leftCols(columns.cols() - 1));
  const VectorXd last = columns.rightCols(1).normalized();
  return (last - others.columns * others.solve(last)).squaredNorm();
}

}  // namespace uncertainty_identification
