#include "bounds/spread_errors.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "math/distributions.h"
#include "uncertainty_identification/math/mixture_coordinates.h"

namespace uncertainty_identification {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// A root whose smallest pivot is below this share of its largest has directions in which the
/// plants do not differ, and in which there is nothing to widen.
constexpr double kSingular = 1e-6;

bool isSingular(const MatrixXd& root) {
  const VectorXd pivots = root.diagonal().cwiseAbs();
  return !(pivots.minCoeff() > kSingular * pivots.maxCoeff());
}

/// The standard deviations of the entries of L^-1 dL, where `covariance` is that of dL's entries.
VectorXd relativeErrors(const MatrixXd& root, const MatrixXd& covariance) {
  const Index entries = covariance.rows(), n = root.rows();
  MatrixXd relative(entries, entries);
  for (Index k = 0; k < entries; ++k)
    relative.col(k) = lowerEntries(
        root.triangularView<Eigen::Lower>().solve(lowerTriangle(VectorXd::Unit(entries, k), n)));
  return (relative * covariance * relative.transpose()).diagonal().cwiseMax(0).cwiseSqrt();
}

}  // namespace

SpreadErrors::SpreadErrors(const Mixture& mixture, const MatrixXd& covariance, int experiments) {
  if (experiments == 0) return;
  const Index n = mixture.dimension(), entries = n * (n + 1) / 2;
  Index first = covariance.rows() - entries * mixture.components();
  for (std::size_t i = 0; i < mixture.weights.size(); ++i, first += entries) {
    const MatrixXd root = lowerRoot(mixture.covariances[i]);
    if (n == 0 || isSingular(root)) continue;
    Component component{first, mixture.weights[i] * experiments, root, {}, {}};
    component.standard = relativeErrors(root, covariance.block(first, first, entries, entries));
    const MatrixXd without_noise =  // standard deviations for experiments without noise
        (MatrixXd::Ones(n, n) - (1 - std::sqrt(0.5)) * MatrixXd::Identity(n, n)) /
        std::sqrt(component.experiments);
    component.widening =
        component.standard.cwiseQuotient(lowerEntries(without_noise)).cwiseMax(1.0);
    components_.push_back(std::move(component));
  }
}

/// The estimate L is drawn as L sqrt(M) B^-T with B upper triangular and B B' of the Wishart
/// distribution with M - 1 degrees of freedom (Bartlett's decomposition). Noise of the measurements
/// adds to the plants' differences: where it makes the errors larger by a factor, so is the
/// deviation from L, and a variance that would be negative is zero.
MatrixXd SpreadErrors::drawnRoot(const Component& component, const MatrixXd& gaussian) const {
  constexpr double kFarthest = 7;  // standard deviations
  const Index n = component.root.rows();
  const double experiments = component.experiments;
  MatrixXd B = MatrixXd::Zero(n, n);
  for (Index k = 0; k < n; ++k) {
    const double degrees = std::max(1.0, experiments - 1 - static_cast<double>(n - 1 - k));
    // Entries that depend on each other may lie farther out than a double has quantiles.
    const double deviation = std::clamp(gaussian(k, k), -kFarthest, kFarthest);
    B(k, k) = std::sqrt(chiSquaredQuantile(normalTail(deviation), degrees));
    for (Index j = k + 1; j < n; ++j) B(k, j) = -gaussian(j, k);
  }
  MatrixXd drawn = std::sqrt(experiments) *
                   B.transpose().triangularView<Eigen::Lower>().solve(MatrixXd::Identity(n, n));
  const MatrixXd widening = lowerTriangle(component.widening, n);
  for (Index k = 0; k < n; ++k) {
    for (Index j = 0; j < k; ++j) drawn(k, j) *= widening(k, j);
    drawn(k, k) = std::sqrt(std::max(0.0, 1 + widening(k, k) * (drawn(k, k) * drawn(k, k) - 1)));
  }
  return component.root * drawn;
}

void SpreadErrors::replaceRoots(const VectorXd& center, VectorXd* mixture_coordinates) const {
  for (const Component& component : components_) {
    const Index n = component.root.rows(), entries = component.standard.size();
    auto root = mixture_coordinates->segment(component.first, entries);
    const MatrixXd error = lowerTriangle(root - center.segment(component.first, entries), n);
    VectorXd gaussian = lowerEntries(component.root.triangularView<Eigen::Lower>().solve(error));
    for (Index k = 0; k < entries; ++k)
      gaussian[k] = component.standard[k] > 0 ? gaussian[k] / component.standard[k] : 0;
    root = lowerEntries(drawnRoot(component, lowerTriangle(gaussian, n)));
  }
}

}  // namespace uncertainty_identification
