#include <algorithm>
#include <cmath>

#include "effects/extended_model.h"
#include "math/pseudo_inverse.h"

/// The points about which an extended model is linearised in each experiment: xi, and the points
/// of effects in whose random size the output is not linear.
namespace uncertainty_identification {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

bool ExtendedModel::isLocallyLinear() const {
  return std::any_of(effects_.begin(), effects_.end(),
                     [](const auto& effect) { return effect->description().nonlinear; });
}

Index ExtendedModel::pointRow(std::size_t k) const {
  if (!effects_[k]->description().own_point) return -1;
  return regressors() + std::count_if(effects_.begin(),
                                      effects_.begin() + static_cast<std::ptrdiff_t>(k),
                                      [](const auto& of) { return of->description().own_point; });
}

/// The points of this model in the rows that they have in `other`, a model with other effects. NaN
/// in the rows of effects that this model does not have.
MatrixXd ExtendedModel::pointsFor(const ExtendedModel& other) const {
  Index rows = regressors();
  for (const auto& effect : other.effects_) rows += effect->description().own_point;
  MatrixXd all = MatrixXd::Constant(rows, points_.cols(), std::nan(""));
  all.topRows(regressors()) = points_.topRows(regressors());
  for (std::size_t k = 0; k < other.effects_.size(); ++k) {
    const auto found = std::find(effects_.begin(), effects_.end(), other.effects_[k]);
    const Index to = other.pointRow(k);
    if (to < 0 || found == effects_.end()) continue;
    const Index from = pointRow(static_cast<std::size_t>(found - effects_.begin()));
    if (from < points_.rows()) all.row(to) = points_.row(from);
  }
  return all;
}

double ExtendedModel::pointAt(std::size_t k, double size, const VectorXd& parameters) const {
  return effects_[k]->pointAt(size, nominal(), theta(parameters.head(own())));
}

MatrixXd ExtendedModel::points(const VectorXd& parameters, const MatrixXd& xi) const {
  MatrixXd all = xi;
  for (std::size_t k = 0; k < effects_.size(); ++k) {
    const Index row = pointRow(k);
    if (row < 0) continue;
    all.conservativeResize(row + 1, Eigen::NoChange);
    all.row(row).setConstant(pointAt(k, 0, parameters));
    if (row >= points_.rows() || points_.cols() != xi.cols()) continue;
    all.row(row) = points_.row(row).array().isNaN().select(all.row(row), points_.row(row));
  }
  return all;
}

MatrixXd ExtendedModel::pointsOf(const std::vector<Block>& blocks, const VectorXd& parameters,
                                 const MatrixXd& xi) const {
  MatrixXd all = points(parameters, xi);
  if (all.rows() == xi.rows()) return all;
  for (const Block& block : blocks) {
    Response response;
    KeptWhitening whitening;
    const Chain chain = value(block, parameters, &whitening, &response);
    Signals left = response.value.residual;
    for (int lane = 0; lane < block.lanes; ++lane) {
      const int r = block.index[static_cast<std::size_t>(lane)];
      for (Index i = 0; i < xi.rows(); ++i)
        left.row(lane) -=
            xi(i, r) * response.value.regressors[static_cast<std::size_t>(i)].row(lane);
      const VectorXd sizes = columnCoefficients(response, left, lane);
      for (std::size_t k = 0; k < effects_.size(); ++k) {
        const Index row = pointRow(k);
        for (std::size_t j = 0; row >= 0 && j < chain.random.size(); ++j) {
          if (chain.random[j].own_point == row)
            all(row, r) =
                pointAt(k, sizes.tail(chain.random.size())[static_cast<Index>(j)], parameters);
        }
      }
    }
  }
  return all;
}

VectorXd ExtendedModel::pointDeviations(const VectorXd& parameters, double noise_variance,
                                        const VectorXd& of_xi) const {
  VectorXd all = of_xi;
  for (std::size_t k = 0; k < effects_.size(); ++k) {
    if (pointRow(k) < 0) continue;
    const double deviation = std::sqrt(noise_variance * std::exp(psi(parameters, k)[0]));
    all.conservativeResize(all.size() + 1);
    all[all.size() - 1] = std::abs(pointAt(k, deviation, parameters) - pointAt(k, 0, parameters));
  }
  return all;
}

VectorXd ExtendedModel::columnCoefficients(const Response& response, const Signals& unexplained,
                                           int lane) {
  const Index columns = response.column_precision.size(), samples = unexplained.cols();
  MatrixXd Z = MatrixXd::Zero(samples, columns);
  for (Index k = 0; k < columns; ++k) {
    const Signals& column = *response.value.columns[static_cast<std::size_t>(k)];
    Z.col(k).head(column.cols()) = column.row(lane).transpose();
  }
  MatrixXd inner = Z.transpose() * Z;
  inner.diagonal() += response.column_precision;
  return PseudoInverse(inner).inverse *
         (Z.transpose() * unexplained.row(lane).transpose().matrix());
}

}  // namespace uncertainty_identification
