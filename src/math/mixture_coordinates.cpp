#include "uncertainty_identification/math/mixture_coordinates.h"

#include <cmath>

namespace uncertainty_identification {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd lowerTriangle(const VectorXd& entries, Index n) {
  MatrixXd L = MatrixXd::Zero(n, n);
  Index entry = 0;
  for (Index row = 0; row < n; ++row) {
    for (Index col = 0; col <= row; ++col) L(row, col) = entries[entry++];
  }
  return L;
}

VectorXd lowerEntries(const MatrixXd& L) {
  VectorXd entries(L.rows() * (L.rows() + 1) / 2);
  Index entry = 0;
  for (Index row = 0; row < L.rows(); ++row) {
    for (Index col = 0; col <= row; ++col) entries[entry++] = L(row, col);
  }
  return entries;
}

/// Cholesky factorisation that leaves out pivots that are zero up to rounding.
MatrixXd lowerRoot(const MatrixXd& A) {
  MatrixXd L = MatrixXd::Zero(A.rows(), A.cols());
  for (Index j = 0; j < A.rows(); ++j) {
    const double pivot = A(j, j) - L.row(j).head(j).squaredNorm();
    if (pivot <= 1e-14 * std::abs(A(j, j))) continue;
    L(j, j) = std::sqrt(pivot);
    for (Index i = j + 1; i < A.rows(); ++i)
      L(i, j) = (A(i, j) - L.row(i).head(j).dot(L.row(j).head(j))) / L(j, j);
  }
  return L;
}

MixtureCoordinates::MixtureCoordinates(int components, int dimension, bool zero_mean,
                                       const MatrixXd& floor)
    : kappa_(components),
      n_(dimension),
      triangle_(n_ * (n_ + 1) / 2),
      zero_mean_(zero_mean),
      floor_(floor.size() > 0 ? floor : MatrixXd::Zero(dimension, dimension)) {}

VectorXd MixtureCoordinates::toCoordinates(const Mixture& mixture) const {
  VectorXd z(size());
  Index next = 0;
  for (int i = 0; i + 1 < kappa_; ++i)
    z[next++] = std::log(mixture.weights[static_cast<std::size_t>(i)] / mixture.weights.back());
  for (int i = 0; i < freeMeans(); ++i, next += n_)
    z.segment(next, n_) = mixture.means[static_cast<std::size_t>(i)];
  for (const MatrixXd& covariance : mixture.covariances) {
    z.segment(next, triangle_) = lowerEntries(lowerRoot(covariance - floor_));
    next += triangle_;
  }
  return z;
}

Mixture MixtureCoordinates::fromCoordinates(const VectorXd& z) const {
  Mixture mixture;
  VectorXd ratios = VectorXd::Zero(kappa_);
  ratios.head(kappa_ - 1) = z.head(kappa_ - 1);
  ratios = (ratios.array() - ratios.maxCoeff()).exp();
  ratios /= ratios.sum();
  mixture.weights.assign(ratios.data(), ratios.data() + kappa_);
  Index next = kappa_ - 1;
  VectorXd sum = VectorXd::Zero(n_);
  for (int i = 0; i < freeMeans(); ++i, next += n_) {
    mixture.means.push_back(z.segment(next, n_));
    sum += ratios[i] * mixture.means.back();
  }
  if (zero_mean_) mixture.means.push_back(-sum / ratios[kappa_ - 1]);
  for (int i = 0; i < kappa_; ++i, next += triangle_) {
    const MatrixXd L = lowerTriangle(z.segment(next, triangle_), n_);
    mixture.covariances.push_back(floor_ + L * L.transpose());
  }
  return mixture;
}

}  // namespace uncertainty_identification
