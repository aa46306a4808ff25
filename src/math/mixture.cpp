#include "uncertainty_identification/math/mixture.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {

Eigen::VectorXd Mixture::mean() const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(dimension());
  for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] * means[i];
  return sum;
}

Eigen::MatrixXd Mixture::covariance() const {
  const Eigen::VectorXd centre = mean();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(dimension(), dimension());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const Eigen::VectorXd away = means[i] - centre;
    sum += weights[i] * (covariances[i] + away * away.transpose());
  }
  return sum;
}

void Mixture::sortComponents() {
  std::vector<std::size_t> order(weights.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [this](std::size_t l, std::size_t r) {
    return std::lexicographical_compare(means[l].data(), means[l].data() + means[l].size(),
                                        means[r].data(), means[r].data() + means[r].size());
  });
  Mixture sorted;
  for (std::size_t i : order) {
    sorted.weights.push_back(weights[i]);
    sorted.means.push_back(means[i]);
    sorted.covariances.push_back(covariances[i]);
  }
  *this = std::move(sorted);
}

void Mixture::validate(const std::string& name) const {
  const auto fail = [&name](const std::string& what) {
    throw ConfigurationError(name + ": " + what);
  };
  if (weights.size() != means.size() || weights.size() != covariances.size()) {
    fail("weights, means and covariances must be of equal number, found " +
         std::to_string(weights.size()) + ", " + std::to_string(means.size()) + " and " +
         std::to_string(covariances.size()));
  }
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const std::string at = "[" + std::to_string(i) + "]";
    if (!(weights[i] > 0) || !std::isfinite(weights[i])) fail("weights" + at + " must be positive");
    sum += weights[i];
    if (means[i].size() != dimension() || !means[i].allFinite()) {
      fail("means" + at + " must hold " + std::to_string(dimension()) + " finite numbers");
    }
    const Eigen::MatrixXd& covariance = covariances[i];
    if (covariance.rows() != dimension() || covariance.cols() != dimension() ||
        !covariance.allFinite()) {
      fail("covariances" + at + " must be a finite " + std::to_string(dimension()) + " x " +
           std::to_string(dimension()) + " matrix");
    }
    if (dimension() == 0) continue;
    const double size = covariance.cwiseAbs().maxCoeff();
    if ((covariance - covariance.transpose()).cwiseAbs().maxCoeff() > 1e-9 * size) {
      fail("covariances" + at + " must be symmetric");
    }
    if (covariance.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff() < -1e-9 * size) {
      fail("covariances" + at + " must be positive semidefinite");
    }
  }
  if (!weights.empty() && std::abs(sum - 1) > 1e-6)
    fail("weights must sum to 1, found " + std::to_string(sum));
}

}  // namespace uncertainty_identification
