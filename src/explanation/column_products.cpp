#include "explanation/column_products.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <numeric>

namespace uncertainty_identification {

using Eigen::Index;

void ColumnProducts::add(const Eigen::VectorXd& row) {
  products_.selfadjointView<Eigen::Lower>().rankUpdate(row);
  ++rows_;
}

bool ColumnProducts::areEnough() const {
  const Index columns = products_.rows();
  return rows_ >= 20 * columns && products_(columns - 1, columns - 1) > 0;
}

double ColumnProducts::leftBy(const std::vector<Index>& columns) const {
  const auto count = static_cast<Index>(columns.size());
  const Index last = products_.rows() - 1;
  Eigen::MatrixXd gram(count, count);
  Eigen::VectorXd with(count);
  for (Index i = 0; i < count; ++i) {
    const Index row = columns[static_cast<std::size_t>(i)];
    with[i] = products_(last, row);
    for (Index j = 0; j < count; ++j) {
      const Index column = columns[static_cast<std::size_t>(j)];
      gram(i, j) = products_(std::max(row, column), std::min(row, column));
    }
  }
  gram.diagonal() *= 1 + 1e-9;
  gram.diagonal().array() += 1e-300;
  return 1 - with.dot(gram.ldlt().solve(with)) / products_(last, last);
}

std::vector<Index> range(Index first, Index count) {
  std::vector<Index> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

}  // namespace uncertainty_identification
