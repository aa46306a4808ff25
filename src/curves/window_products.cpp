#include "curves/window_products.h"

namespace uncertainty_identification {
/// By Gram and Schmidt, twice.
Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd basis(columns.rows(), columns.cols());
  Eigen::Index count = 0;
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    Eigen::VectorXd column = columns.col(k);
    const double length = column.norm();
    for (int pass = 0; pass < 2; ++pass)
      column -= basis.leftCols(count) * (basis.leftCols(count).transpose() * column);
    if (!(column.norm() > 1e-9 * length)) continue;
    basis.col(count++) = column.normalized();
  }
  return basis.leftCols(count);
}

WindowProducts::Block WindowProducts::total() const {
  Block sum = blocks.front();
  for (std::size_t k = 1; k < blocks.size(); ++k) {
    sum.jj += blocks[k].jj;
    sum.jr += blocks[k].jr;
    sum.rr += blocks[k].rr;
  }
  return sum;
}

WindowProducts productsOf(const CurveModel& model, const std::vector<CurveTable>& tables,
                          const SimulationWindow& window, const Eigen::VectorXd& initial,
                          int blocks) {
  FreeSimulation simulated = simulateFreely(model, tables, window, initial, true);
  const int samples = window.samples(), parameters = model.parameters();
  for (int k = 0; k < samples; ++k)
    if (window.measured[k] == 0) simulated.derivatives.col(k).setZero();
  Eigen::VectorXd residual = (window.measured * (window.y - simulated.y).array()).matrix();
  Eigen::MatrixXd by_theta = simulated.derivatives.topRows(parameters).transpose();
  const Eigen::MatrixXd by_state =
      simulated.derivatives.bottomRows(model.initialValues()).transpose();
  WindowProducts products;
  products.xx = by_state.transpose() * by_state;
  products.xj = by_state.transpose() * by_theta;
  products.xr = by_state.transpose() * residual;
  products.squared_error = residual.squaredNorm();
  const Eigen::MatrixXd basis = orthonormal(by_state);
  residual -= basis * (basis.transpose() * residual);
  by_theta -= basis * (basis.transpose() * by_theta);
  for (int block = 0; block < blocks; ++block) {
    const int begin = block * samples / blocks, length = (block + 1) * samples / blocks - begin;
    const auto part = by_theta.middleRows(begin, length);
    const auto rest = residual.segment(begin, length);
    products.blocks.push_back(
        {part.transpose() * part, part.transpose() * rest, rest.squaredNorm()});
  }
  products.residual = std::move(residual);
  return products;
}

double errorAfter(const WindowProducts::Block& block, const Eigen::VectorXd& step) {
  return block.rr - 2 * step.dot(block.jr) + step.dot(block.jj * step);
}

}  // namespace uncertainty_identification
