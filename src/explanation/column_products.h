#pragma once

#include <Eigen/Core>
#include <vector>

namespace uncertainty_identification {

/// Sums of products of columns, row by row: what the last column is told by others.
class ColumnProducts {
 public:
  explicit ColumnProducts(Eigen::Index columns)
      : products_(Eigen::MatrixXd::Zero(columns, columns)) {}

  void add(const Eigen::VectorXd& row);

  /// Whether there are rows enough for all columns, and the last one moves.
  bool areEnough() const;

  /// The share of the last column's squares that these columns leave, by least squares.
  double leftBy(const std::vector<Eigen::Index>& columns) const;

 private:
  Eigen::MatrixXd products_;  ///< its lower half
  Eigen::Index rows_ = 0;
};

/// first, first + 1, ..., first + count - 1.
std::vector<Eigen::Index> range(Eigen::Index first, Eigen::Index count);

}  // namespace uncertainty_identification
