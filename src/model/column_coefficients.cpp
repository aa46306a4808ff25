#include "model/column_coefficients.h"

#include "math/pseudo_inverse.h"
#include "model/filter.h"

namespace uncertainty_identification {

using Eigen::Index;
using Eigen::MatrixXd;

std::vector<MatrixXd> gramOf(std::vector<const Signals*> signals, int lanes) {
  for (const Signals*& signal : signals) {
    if (signal->cols() == 0) signal = nullptr;
  }
  const auto size = static_cast<Index>(signals.size());
  const std::vector<Lanes> sums = innerProducts(signals, signals);
  std::vector<MatrixXd> grams(static_cast<std::size_t>(lanes), MatrixXd(size, size));
  for (int lane = 0; lane < lanes; ++lane) {
    for (Index i = 0; i < size * size; ++i) {
      grams[static_cast<std::size_t>(lane)](i / size, i % size) =
          sums[static_cast<std::size_t>(i)][lane];
    }
  }
  return grams;
}

MatrixXd columnCoefficients(const Response& response, const Signals& unexplained, int lanes) {
  const Index columns = response.column_precision.size();
  std::vector<const Signals*> list;
  for (const auto& column : response.value.columns) list.push_back(column.get());
  list.push_back(&unexplained);
  const std::vector<MatrixXd> grams = gramOf(list, lanes);
  MatrixXd zeta = MatrixXd::Zero(columns, kLanes);
  for (int lane = 0; lane < lanes; ++lane) {
    MatrixXd inner = grams[static_cast<std::size_t>(lane)].topLeftCorner(columns, columns);
    inner.diagonal() += response.column_precision;
    zeta.col(lane) = PseudoInverse(inner).inverse *
                     grams[static_cast<std::size_t>(lane)].topRightCorner(columns, 1);
  }
  return zeta;
}

Signals unexplainedBy(const Response& response, const Block& block, const MatrixXd& xi) {
  Signals unexplained = response.value.residual;
  for (std::size_t i = 0; i < response.value.regressors.size(); ++i) {
    const Signals& regressor = response.value.regressors[i];
    for (int lane = 0; lane < block.lanes && regressor.cols() > 0; ++lane)
      unexplained.row(lane) -=
          xi(static_cast<Index>(i), block.index[static_cast<std::size_t>(lane)]) *
          regressor.row(lane);
  }
  return unexplained;
}

}  // namespace uncertainty_identification
