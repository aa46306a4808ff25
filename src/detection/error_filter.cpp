#include "detection/error_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "math/constants.h"
#include "math/distributions.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kDiffuse = 1e8;        // prior variance of c, divided by sigma^2
constexpr double kUndetermined = 1e4;   // above this variance / sigma^2 a sample has no score
constexpr double kLargestScore = 37.0;  // beyond it the normal tail underflows

/// The normal quantile of a probability, given with its complement: small probabilities at either
/// end keep their precision.
double normalScore(double below, double above) {
  const double tail = std::min(below, above);
  const double size = tail < 1e-298 ? kLargestScore : normalTailQuantile(tail);
  return above < below ? size : -size;
}

}  // namespace

ErrorFilter::ErrorFilter(const Mixture& mixture, Index parameters, Index columns,
                         double noise_variance)
    : dimension_(mixture.dimension()),
      parameters_(parameters),
      columns_(columns),
      noise_variance_(noise_variance) {
  const Index size = dimension_ + parameters_ + columns_;
  const int count = std::max(mixture.components(), 1);
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(i);
    Component component;
    component.mean = VectorXd::Zero(size);
    component.covariance = MatrixXd::Zero(size, size);
    component.covariance.diagonal().segment(dimension_, parameters_).setOnes();
    component.covariance.diagonal().tail(columns_).setConstant(kDiffuse * noise_variance_);
    if (mixture.components() > 0) {
      component.log_weight = std::log(mixture.weights[at]);
      component.mean.head(dimension_) = mixture.means[at];
      component.covariance.topLeftCorner(dimension_, dimension_) = mixture.covariances[at];
    }
    components_.push_back(std::move(component));
  }
}

void ErrorFilter::predict(const WhitenedObservation& o, Component* c) const {
  c->direction.resize(c->mean.size());
  const auto xi = c->mean.head(dimension_);
  const auto z = c->mean.segment(dimension_, parameters_);
  c->direction.head(dimension_) = o.regressors;
  c->direction.tail(columns_) = o.columns;
  double product = 0;  // (z'dPhi) xi, which is contained twice in direction * mean
  if (parameters_ > 0) {
    const VectorXd of_parameters = o.regressor_derivatives * xi;
    c->direction.segment(dimension_, parameters_) = of_parameters - o.residual_derivative;
    c->direction.head(dimension_) += o.regressor_derivatives.transpose() * z;
    product = z.dot(of_parameters);
  }
  c->innovation = o.residual - c->direction.dot(c->mean) + product;
  // Beside diffuse variances, rounding may leave a small quadratic form below zero.
  c->variance = noise_variance_ + std::max(c->direction.dot(c->covariance * c->direction), 0.0);
}

/// The measurement update of the Kalman filter, in Joseph's form: it stays positive definite where
/// variances are diffuse or of very different sizes.
void ErrorFilter::correct(Component* c) const {
  const VectorXd gain = c->covariance * c->direction / c->variance;
  c->mean += gain * c->innovation;
  const MatrixXd left =
      MatrixXd::Identity(gain.size(), gain.size()) - gain * c->direction.transpose();
  c->covariance =
      (left * c->covariance * left.transpose()).eval() + noise_variance_ * gain * gain.transpose();
}

Score ErrorFilter::update(const WhitenedObservation& observation) {
  Score score;
  double largest = -std::numeric_limits<double>::infinity();
  std::vector<double> logs;
  for (Component& c : components_) {
    predict(observation, &c);
    logs.push_back(c.log_weight);
    const VectorXd of_columns = c.direction.tail(columns_);
    const double unknown =
        of_columns.dot(c.covariance.bottomRightCorner(columns_, columns_) * of_columns);
    if (unknown > kUndetermined * noise_variance_) score.diffuse = true;
    const double density =
        -0.5 * (std::log((2 * kPi) * c.variance) + c.innovation * c.innovation / c.variance);
    largest = std::max(largest, c.log_weight + density);
    c.log_weight += density;
  }
  // The score if one component has probability 1. It is exact in far tails, where `below` and
  // `above` lose precision.
  std::optional<double> certain;
  double below = 0, above = 0, mean = 0, second = 0, sum = 0;
  for (std::size_t i = 0; i < components_.size(); ++i) {
    Component& c = components_[i];
    const double weight = std::exp(logs[i]), deviation = std::sqrt(c.variance);
    const double standardised = c.innovation / deviation;
    const double scaled = standardised / std::sqrt(2.0);
    below += weight * 0.5 * std::erfc(-scaled);
    above += weight * 0.5 * std::erfc(scaled);
    mean += weight * c.innovation;
    second += weight * (c.variance + c.innovation * c.innovation);
    if (weight > 1 - 1e-14) certain = standardised;
    sum += std::exp(c.log_weight - largest);
    correct(&c);
  }
  score.value = certain ? *certain : normalScore(below, above);
  score.deviation = std::sqrt(std::max(second - mean * mean, noise_variance_));
  score.log_density = largest + std::log(sum);
  for (Component& c : components_) c.log_weight -= score.log_density;
  return score;
}

std::vector<double> ErrorFilter::probabilities() const {
  std::vector<double> all;
  for (const Component& c : components_) all.push_back(std::exp(c.log_weight));
  return all;
}

VectorXd ErrorFilter::errorMean() const {
  VectorXd mean = VectorXd::Zero(dimension_);
  for (const Component& c : components_) mean += std::exp(c.log_weight) * c.mean.head(dimension_);
  return mean;
}

}  // namespace uncertainty_identification
