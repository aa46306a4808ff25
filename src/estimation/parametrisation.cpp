#include "estimation/parametrisation.h"

#include <cmath>

namespace uncertainty_identification {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

Parametrisation::Parametrisation(const Model& model, Constraint constraint, int components,
                                 const MatrixXd& floor)
    : model_(model),
      constraint_(constraint),
      p_(model.parameterCount()),
      n_(model.regressors()),
      kappa_(components),
      triangle_(n_ * (n_ + 1) / 2),
      mixture_(components, n_, constraint == Constraint::zero_mean, floor) {}

int Parametrisation::size() const { return p_ + mixture_.size() + 1; }

int Parametrisation::naturalSize() const { return p_ + kappa_ * (1 + n_ + triangle_) + 1; }

VectorXd Parametrisation::toCoordinates(const ModelParameters& at) const {
  VectorXd z(size());
  z << model_.toUnbounded(at.parameters), mixture_.toCoordinates(at.mixture),
      std::log(at.noise_variance);
  return z;
}

ModelParameters Parametrisation::fromCoordinates(const VectorXd& z) const {
  return {model_.fromUnbounded(z.head(p_)),
          mixture_.fromCoordinates(z.segment(p_, mixture_.size())), std::exp(z[z.size() - 1])};
}

MatrixXd Parametrisation::jacobian(const VectorXd& z) const {
  const ModelParameters at = fromCoordinates(z);
  MatrixXd J = MatrixXd::Zero(naturalSize(), size());
  J.topLeftCorner(p_, p_) = model_.unboundedJacobian(z.head(p_));
  const Eigen::Map<const VectorXd> weights(at.mixture.weights.data(), kappa_);
  for (int i = 0; i < kappa_; ++i) {
    for (int j = 0; j + 1 < kappa_; ++j)
      J(p_ + i, p_ + j) = weights[i] * ((i == j ? 1.0 : 0.0) - weights[j]);
  }
  const Index mean_row = p_ + kappa_, mean_col = p_ + kappa_ - 1;
  J.block(mean_row, mean_col, freeMeans() * n_, freeMeans() * n_).setIdentity();
  if (zeroMean()) {  // mu_kappa = -sum_i alpha_i mu_i / alpha_kappa, and the ratios
                     // alpha_i/alpha_kappa are e^(z_i)
    const Index last = mean_row + (kappa_ - 1) * n_;
    for (int i = 0; i + 1 < kappa_; ++i) {
      const double ratio = weights[i] / weights[kappa_ - 1];
      J.block(last, mean_col + i * n_, n_, n_).diagonal().setConstant(-ratio);
      J.block(last, p_ + i, n_, 1) = -ratio * at.mixture.means[static_cast<std::size_t>(i)];
    }
  }
  Index row = mean_row + kappa_ * n_, col = mean_col + freeMeans() * n_;
  for (int i = 0; i < kappa_; ++i, row += triangle_, col += triangle_) {
    const MatrixXd L = lowerTriangle(z.segment(col, triangle_), n_);
    for (Index e = 0; e < triangle_; ++e) {
      const MatrixXd dL = lowerTriangle(VectorXd::Unit(triangle_, e), n_);
      J.block(row, col + e, triangle_, 1) = lowerEntries(dL * L.transpose() + L * dL.transpose());
    }
  }
  J(row, col) = 1;
  return J;
}

std::vector<std::string> Parametrisation::naturalNames() const {
  std::vector<std::string> names = model_.names();
  const auto number = [](int k) { return std::to_string(k + 1); };
  for (int i = 0; i < kappa_; ++i) names.push_back("weight" + number(i));
  for (int i = 0; i < kappa_; ++i) {
    for (int k = 0; k < n_; ++k) names.push_back("mean" + number(i) + "[" + number(k) + "]");
  }
  for (int i = 0; i < kappa_; ++i) {
    for (int k = 0; k < n_; ++k) {
      for (int l = 0; l <= k; ++l) {
        names.push_back("covariance" + number(i) + "[" + number(k) + "," + number(l) + "]");
      }
    }
  }
  names.push_back("noise_variance");
  return names;
}

VectorXd Parametrisation::natural(const ModelParameters& at) const {
  VectorXd values(naturalSize());
  values.head(p_) = at.parameters;
  Index next = p_;
  for (double weight : at.mixture.weights) values[next++] = weight;
  for (const VectorXd& mean : at.mixture.means) {
    values.segment(next, n_) = mean;
    next += n_;
  }
  for (const MatrixXd& covariance : at.mixture.covariances) {
    values.segment(next, triangle_) = lowerEntries(covariance);
    next += triangle_;
  }
  values[next] = at.noise_variance;
  return values;
}

}  // namespace uncertainty_identification
