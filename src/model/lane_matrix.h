#pragma once

#include <Eigen/Core>
#include <vector>

#include "uncertainty_identification/model/block.h"

namespace uncertainty_identification {

/// Sums of products for each lane of a block: a matrix of Lanes, row by row.
class LaneMatrix {
 public:
  LaneMatrix(Eigen::Index rows, Eigen::Index columns)
      : rows_(rows),
        columns_(columns),
        values_(static_cast<std::size_t>(rows * columns), Lanes::Zero()) {}
  Lanes& operator()(Eigen::Index i, Eigen::Index j) {
    return values_[static_cast<std::size_t>(i * columns_ + j)];
  }
  const Lanes& operator()(Eigen::Index i, Eigen::Index j) const {
    return values_[static_cast<std::size_t>(i * columns_ + j)];
  }
  Eigen::Index columns() const { return columns_; }
  Eigen::Index rows() const { return rows_; }
  void setZero() {
    for (Lanes& value : values_) value.setZero();
  }
  double* data() { return values_.empty() ? nullptr : values_.front().data(); }
  std::vector<Lanes>& values() { return values_; }

  Eigen::MatrixXd lane(int lane) const {
    Eigen::MatrixXd one(rows(), columns_);
    for (Eigen::Index i = 0; i < one.rows(); ++i) {
      for (Eigen::Index j = 0; j < columns_; ++j) one(i, j) = (*this)(i, j)[lane];
    }
    return one;
  }

 private:
  Eigen::Index rows_, columns_;
  std::vector<Lanes> values_;
};

}  // namespace uncertainty_identification
