#include "model/model.h"

#include <cmath>
#include <unordered_map>

#include "math/pseudo_inverse.h"
#include "model/filter.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The signals [Z Phi e] as a list of pointers; a signal that is zero is null.
std::vector<const Signals*> listed(const WhitenedSignals& signals, std::size_t columns,
                                   std::size_t regressors) {
  std::vector<const Signals*> all(columns + regressors + 1, nullptr);
  const auto put = [&all](std::size_t at, const Signals& signal) {
    if (signal.cols() > 0) all[at] = &signal;
  };
  for (std::size_t k = 0; k < signals.columns.size(); ++k) all[k] = signals.columns[k].get();
  for (std::size_t k = 0; k < signals.regressors.size(); ++k)
    put(columns + k, signals.regressors[k]);
  put(columns + regressors, signals.residual);
  return all;
}

/// Inner products of the value's signals with each other and with the signals of all derivatives. A
/// signal that occurs several times is processed once.
class Products {
 public:
  Products(const Response& response, bool derivatives)
      : columns_(static_cast<std::size_t>(response.column_precision.size())),
        regressors_(response.value.regressors.size()),
        value_(listed(response.value, columns_, regressors_)),
        of_value_(innerProducts(value_, value_)) {
    if (!derivatives) return;
    std::vector<const Signals*> distinct;
    for (const WhitenedSignals& tangent : response.derivatives) {
      tangents_.push_back(listed(tangent, columns_, regressors_));
      for (const Signals* signal : tangents_.back()) {
        if (signal != nullptr && row_.emplace(signal, distinct.size()).second)
          distinct.push_back(signal);
      }
    }
    of_tangents_ = innerProducts(distinct, value_);
  }

  /// Gram matrix of [Z Phi e] in one lane.
  MatrixXd gram(int lane) const {
    const auto size = static_cast<Index>(value_.size());
    MatrixXd gram(size, size);
    for (Index i = 0; i < size; ++i) {
      for (Index j = 0; j < size; ++j)
        gram(i, j) = of_value_[static_cast<std::size_t>(i * size + j)][lane];
    }
    return gram;
  }

  /// Derivative of this matrix with respect to parameter j.
  MatrixXd derivative(std::size_t j, int lane) const {
    const std::size_t size = value_.size();
    MatrixXd half = MatrixXd::Zero(static_cast<Index>(size), static_cast<Index>(size));
    for (std::size_t i = 0; i < size; ++i) {
      const Signals* signal = tangents_[j][i];
      if (signal == nullptr) continue;
      const std::size_t row = row_.at(signal) * size;
      for (std::size_t k = 0; k < size; ++k)
        half(static_cast<Index>(i), static_cast<Index>(k)) = of_tangents_[row + k][lane];
    }
    return half + half.transpose();
  }

 private:
  std::size_t columns_, regressors_;
  std::vector<const Signals*> value_;
  std::vector<Lanes> of_value_, of_tangents_;
  std::vector<std::vector<const Signals*>> tangents_;
  std::unordered_map<const Signals*, std::size_t> row_;
};

/// Removes the random-effect columns Z of one experiment from the Gram matrix of [Z Phi e] by
/// integrating over their coefficients zeta. What remains is the Schur complement of Z'Z +
/// precision, and the log-Jacobian -1/2 ln det(Z'Z + precision) + 1/2 ln det precision, the last
/// determinant over columns with a proper prior only (docs/method.md, section on random-effect
/// columns).
class Absorption {
 public:
  Absorption(const MatrixXd& gram, const VectorXd& precision)
      : columns_(precision.size()), rest_(gram.rows() - columns_) {
    MatrixXd inner = gram.topLeftCorner(columns_, columns_);
    inner.diagonal() += precision;
    const PseudoInverse pseudo(inner);
    inverse_ = pseudo.inverse;
    projection_ = inverse_ * gram.topRightCorner(columns_, rest_);
    gram_ =
        gram.bottomRightCorner(rest_, rest_) - gram.bottomLeftCorner(rest_, columns_) * projection_;
    log_jacobian_ = -0.5 * pseudo.log_determinant;
    diffuse_ = pseudo.rank - columns_;
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

  /// Derivative of gram(), given the derivatives `dgram` of the Gram matrix of [Z Phi e] and
  /// `dprecision` of the precisions.
  MatrixXd derivative(const MatrixXd& dgram, const VectorXd* dprecision) const {
    MatrixXd dinner = dgram.topLeftCorner(columns_, columns_);
    if (dprecision != nullptr) dinner.diagonal() += *dprecision;
    const MatrixXd cross = dgram.bottomLeftCorner(rest_, columns_) * projection_;
    return dgram.bottomRightCorner(rest_, rest_) - cross - cross.transpose() +
           projection_.transpose() * dinner * projection_;
  }

  double logJacobianDerivative(const MatrixXd& dgram, const VectorXd& precision,
                               const VectorXd* dprecision) const {
    double derivative = -0.5 * inverse_.cwiseProduct(dgram.topLeftCorner(columns_, columns_)).sum();
    for (Index k = 0; dprecision != nullptr && k < columns_; ++k) {
      derivative -= 0.5 * inverse_(k, k) * (*dprecision)[k];
      if (precision[k] > 0) derivative += 0.5 * (*dprecision)[k] / precision[k];
    }
    return derivative;
  }

 private:
  Index columns_, rest_;
  Index diffuse_ = 0;
  MatrixXd inverse_, projection_, gram_;
  double log_jacobian_ = 0;
};

void write(const Response& response, const Block& block, Statistics* statistics) {
  const Products products(response, statistics->parameters() > 0);
  for (int lane = 0; lane < block.lanes; ++lane) {
    const int r = block.index[static_cast<std::size_t>(lane)];
    const Absorption absorbed(products.gram(lane), response.column_precision);
    statistics->gram(r) = absorbed.gram();
    statistics->samples()[r] = response.effective_samples[lane] - absorbed.diffuse();
    statistics->logJacobian()[r] = response.value.log_jacobian[lane] + absorbed.logJacobian();
    for (int j = 0; j < statistics->parameters(); ++j) {
      const auto at = static_cast<std::size_t>(j);
      const VectorXd* dprecision = response.column_precision_derivatives.empty()
                                       ? nullptr
                                       : &response.column_precision_derivatives[at];
      const MatrixXd dgram = products.derivative(at, lane);
      statistics->gramDerivative(r, j) = absorbed.derivative(dgram, dprecision);
      statistics->logJacobianDerivatives()(j, r) =
          response.derivatives[at].log_jacobian[lane] +
          absorbed.logJacobianDerivative(dgram, response.column_precision, dprecision);
    }
  }
}

}  // namespace

void computeStatistics(const Model& model, const Block& block, const VectorXd& parameters,
                       Statistics* statistics, Response* response) {
  *response = Response();
  model.evaluate(block, parameters, statistics->parameters() > 0, response);
  write(*response, block, statistics);
}

}  // namespace uncertainty_identification
