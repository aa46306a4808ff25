#include "uncertainty_identification/model/model.h"

#include <Eigen/Cholesky>
#include <cmath>

#include "uncertainty_identification/model/filter.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// [Z Phi e] as a list; a signal that stands for zero is null.
std::vector<const Signals*> listed(const WhitenedSignals& signals, std::size_t columns, std::size_t regressors) {
  std::vector<const Signals*> all(columns + regressors + 1, nullptr);
  const auto put = [&all](std::size_t at, const Signals& signal) {
    if (signal.cols() > 0) all[at] = &signal;
  };
  for (std::size_t k = 0; k < signals.columns.size(); ++k) put(k, signals.columns[k]);
  for (std::size_t k = 0; k < signals.regressors.size(); ++k) put(columns + k, signals.regressors[k]);
  put(columns + regressors, signals.residual);
  return all;
}

/// Gram matrices left'right per lane.
std::array<MatrixXd, kLanes> gram(const std::vector<const Signals*>& left, const std::vector<const Signals*>& right,
                                  int lanes, bool symmetric) {
  std::array<MatrixXd, kLanes> grams;
  const Index size = static_cast<Index>(left.size());
  for (int lane = 0; lane < lanes; ++lane) grams[static_cast<std::size_t>(lane)] = MatrixXd::Zero(size, size);
  for (Index i = 0; i < size; ++i) {
    for (Index j = symmetric ? i : 0; j < size; ++j) {
      const Signals *l = left[static_cast<std::size_t>(i)], *r = right[static_cast<std::size_t>(j)];
      if (l == nullptr || r == nullptr) continue;
      const Lanes sums = dot(*l, *r);
      for (int lane = 0; lane < lanes; ++lane) {
        MatrixXd& of_lane = grams[static_cast<std::size_t>(lane)];
        of_lane(i, j) = sums[lane];
        if (symmetric) of_lane(j, i) = sums[lane];
      }
    }
  }
  return grams;
}

/// Absorbs the columns Z of one experiment into the Gram matrix of [Z Phi e]: integrating zeta out leaves the Schur
/// complement of Z'Z + precision and the log-Jacobian -1/2 ln det(Z'Z + precision) + 1/2 ln det precision (the latter
/// over the proper columns only); docs/method.md, section on random-effect columns.
class Absorption {
 public:
  Absorption(const MatrixXd& gram, const VectorXd& precision)
      : columns_(precision.size()), rest_(gram.rows() - columns_) {
    MatrixXd inner = gram.topLeftCorner(columns_, columns_);
    inner.diagonal() += precision;
    // a column that vanishes in this experiment (an experiment shorter than the column's delay) leaves no trace
    for (Index k = 0; k < columns_; ++k) {
      if (inner(k, k) <= 0) {
        inner(k, k) = 1;
        ++vanished_;
      }
    }
    inverse_ = inner.llt().solve(MatrixXd::Identity(columns_, columns_));
    projection_ = inverse_ * gram.topRightCorner(columns_, rest_);
    gram_ = gram.bottomRightCorner(rest_, rest_) - gram.bottomLeftCorner(rest_, columns_) * projection_;
    log_jacobian_ = -inner.llt().matrixLLT().diagonal().array().log().sum();
    diffuse_ = -vanished_;
    for (Index k = 0; k < columns_; ++k) {
      if (precision[k] > 0) {
        log_jacobian_ += 0.5 * std::log(precision[k]);
      } else {
        ++diffuse_;
      }
    }
  }

  const MatrixXd& gram() const { return gram_; }
  double logJacobian() const { return log_jacobian_; }
  double diffuse() const { return static_cast<double>(diffuse_); }

  /// Derivative of gram() when the Gram matrix of [Z Phi e] and the precision change by `dgram`, `dprecision`.
  MatrixXd derivative(const MatrixXd& dgram, const VectorXd* dprecision) const {
    MatrixXd dinner = dgram.topLeftCorner(columns_, columns_);
    if (dprecision != nullptr) dinner.diagonal() += *dprecision;
    const MatrixXd cross = dgram.bottomLeftCorner(rest_, columns_) * projection_;
    return dgram.bottomRightCorner(rest_, rest_) - cross - cross.transpose() +
           projection_.transpose() * dinner * projection_;
  }

  double logJacobianDerivative(const MatrixXd& dgram, const VectorXd& precision, const VectorXd* dprecision) const {
    double derivative = -0.5 * inverse_.cwiseProduct(dgram.topLeftCorner(columns_, columns_)).sum();
    for (Index k = 0; dprecision != nullptr && k < columns_; ++k) {
      derivative -= 0.5 * inverse_(k, k) * (*dprecision)[k];
      if (precision[k] > 0) derivative += 0.5 * (*dprecision)[k] / precision[k];
    }
    return derivative;
  }

 private:
  Index columns_, rest_;
  Index vanished_ = 0, diffuse_ = 0;
  MatrixXd inverse_, projection_, gram_;
  double log_jacobian_ = 0;
};

void write(const Response& response, const Block& block, Statistics* statistics) {
  const std::size_t columns = static_cast<std::size_t>(response.column_precision.size());
  const std::size_t regressors = response.value.regressors.size();
  const std::vector<const Signals*> value = listed(response.value, columns, regressors);
  const auto grams = gram(value, value, block.lanes, true);
  std::vector<Absorption> absorbed;
  for (int lane = 0; lane < block.lanes; ++lane) {
    const auto at = static_cast<std::size_t>(lane);
    const int r = block.index[at];
    absorbed.emplace_back(grams[at], response.column_precision);
    statistics->gram(r) = absorbed.back().gram();
    statistics->samples()[r] = response.effective_samples[lane] - absorbed.back().diffuse();
    statistics->logJacobian()[r] = response.value.log_jacobian[lane] + absorbed.back().logJacobian();
  }
  for (int j = 0; j < statistics->parameters(); ++j) {
    const WhitenedSignals& tangent = response.derivatives[static_cast<std::size_t>(j)];
    const auto half = gram(listed(tangent, columns, regressors), value, block.lanes, false);
    const VectorXd* dprecision = response.column_precision_derivatives.empty()
                                     ? nullptr
                                     : &response.column_precision_derivatives[static_cast<std::size_t>(j)];
    for (int lane = 0; lane < block.lanes; ++lane) {
      const auto at = static_cast<std::size_t>(lane);
      const int r = block.index[at];
      const MatrixXd dgram = half[at] + half[at].transpose();
      statistics->gramDerivative(r, j) = absorbed[at].derivative(dgram, dprecision);
      statistics->logJacobianDerivatives()(j, r) =
          tangent.log_jacobian[lane] +
          absorbed[at].logJacobianDerivative(dgram, response.column_precision, dprecision);
    }
  }
}

}  // namespace

void computeStatistics(const Model& model, const Block& block, const VectorXd& parameters, Statistics* statistics) {
  const bool derivatives = statistics->parameters() > 0;
  if (model.fusedStatistics(block, parameters, derivatives, statistics)) return;
  Response response;
  model.evaluate(block, parameters, derivatives, &response);
  write(response, block, statistics);
}

}  // namespace uncertainty_identification
