#pragma once

#include <Eigen/Cholesky>
#include <cmath>

namespace uncertainty_identification {

constexpr int kMostRegressors = 11;

/// Sizes known to the compiler for small n, and no allocation for the others.
template <int n>
using Square = Eigen::Matrix<double, n, n, 0, n == Eigen::Dynamic ? kMostRegressors : n,
                             n == Eigen::Dynamic ? kMostRegressors : n>;
template <int n>
using Column = Eigen::Matrix<double, n, 1, 0, n == Eigen::Dynamic ? kMostRegressors : n, 1>;

/// Cholesky factor K = L L' of a symmetric matrix of a fixed size up to 3. Eigen's LLT gives the
/// same bits, but takes ten seconds to compile for each fixed size, because it brings along what
/// large matrices need.
template <int n>
class SmallCholesky {
 public:
  explicit SmallCholesky(const Square<n>& K) : L_(K) {
    for (int k = 0; k < n; ++k) {
      double pivot = L_(k, k);
      if (k > 0) pivot -= dot(k, k);
      if (pivot <= 0) return;
      L_(k, k) = pivot = std::sqrt(pivot);
      for (int i = k + 1; i < n; ++i) {
        if (k > 0) L_(i, k) -= dot(i, k);
        L_(i, k) /= pivot;
      }
    }
    succeeded_ = true;
  }

  bool succeeded() const { return succeeded_; }
  double diagonal(Eigen::Index k) const { return L_(k, k); }

  /// K^-1 b.
  Column<n> solve(Column<n> b) const {
    for (int i = 0; i < n; ++i) {
      if (i > 0) b[i] -= L_.row(i).head(i).transpose().cwiseProduct(b.head(i)).sum();
      b[i] /= L_(i, i);
    }
    for (int i = n - 1; i >= 0; --i) {
      const int below = n - 1 - i;
      if (below > 0) b[i] -= L_.col(i).tail(below).cwiseProduct(b.tail(below)).sum();
      b[i] /= L_(i, i);
    }
    return b;
  }

  /// K^-1 B.
  Square<n> solveColumns(Square<n> B) const {
    if (n == 1) return B / L_(0, 0) / L_(0, 0);
    for (int k = 0; k < n; ++k) {
      B.row(k) *= 1 / L_(k, k);
      for (int i = k + 1; i < n; ++i) B.row(i) -= L_(i, k) * B.row(k);
    }
    for (int i = n - 1; i >= 0; --i) {
      Eigen::Matrix<double, 1, n> sum = Eigen::Matrix<double, 1, n>::Zero();
      for (int j = i + 1; j < n; ++j) sum += L_(j, i) * B.row(j);
      B.row(i) = (B.row(i) - sum) * (1 / L_(i, i));
    }
    return B;
  }

 private:
  /// Inner product of rows i and k of L over the first k columns.
  double dot(int i, int k) const {
    double sum = L_(i, 0) * L_(k, 0);
    for (int j = 1; j < k; ++j) sum += L_(i, j) * L_(k, j);
    return sum;
  }

  Square<n> L_;
  bool succeeded_ = false;
};

/// The same for any size up to kMostRegressors.
template <>
class SmallCholesky<Eigen::Dynamic> {
 public:
  explicit SmallCholesky(const Square<Eigen::Dynamic>& K) : factor_(K) {}

  bool succeeded() const { return factor_.info() == Eigen::Success; }
  double diagonal(Eigen::Index k) const { return factor_.matrixLLT()(k, k); }
  Column<Eigen::Dynamic> solve(const Column<Eigen::Dynamic>& b) const { return factor_.solve(b); }
  Square<Eigen::Dynamic> solveColumns(const Square<Eigen::Dynamic>& B) const {
    return factor_.solve(B);
  }

 private:
  Eigen::LLT<Square<Eigen::Dynamic>> factor_;
};

}  // namespace uncertainty_identification
