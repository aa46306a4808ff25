#pragma once

#include <Eigen/Core>

#include "uncertainty_identification/math/mixture.h"

namespace uncertainty_identification {

/// Unbounded coordinates of a mixture: the logarithms of the ratios of the weights to the last one;
/// the means (with zero_mean the last mean follows from the others); the lower triangular matrices
/// L_i in Gamma_i = floor + L_i L_i'.
class MixtureCoordinates {
 public:
  /// `floor` (n x n, positive semidefinite; empty = zero) is the smallest covariance that a
  /// component may have.
  MixtureCoordinates(int components, int dimension, bool zero_mean,
                     const Eigen::MatrixXd& floor = {});

  int size() const { return kappa_ - 1 + freeMeans() * n_ + kappa_ * triangle_; }

  Eigen::VectorXd toCoordinates(const Mixture& mixture) const;
  Mixture fromCoordinates(const Eigen::VectorXd& coordinates) const;

 private:
  int freeMeans() const { return zero_mean_ ? kappa_ - 1 : kappa_; }

  int kappa_, n_, triangle_;
  bool zero_mean_;
  Eigen::MatrixXd floor_;
};

/// The entries of the lower triangle, row by row, and the triangular matrix with given entries.
Eigen::VectorXd lowerEntries(const Eigen::MatrixXd& matrix);
Eigen::MatrixXd lowerTriangle(const Eigen::VectorXd& entries, Eigen::Index n);

/// A lower triangular L with L L' = A for positive semidefinite A. Pivots that are zero up to
/// rounding count as zero.
Eigen::MatrixXd lowerRoot(const Eigen::MatrixXd& A);

}  // namespace uncertainty_identification
