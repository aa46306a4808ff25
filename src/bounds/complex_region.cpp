#include "uncertainty_identification/bounds/complex_region.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>

#include "bounds/structure_bound.h"
#include "math/constants.h"
#include "math/interruption.h"
#include "uncertainty_identification/bounds/bands.h"

namespace uncertainty_identification {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr int kDirections = 12;  // each is used together with its opposite

using Polygon = std::vector<Vector2d>;

/// The part of a convex polygon inside the half plane normal'x <= limit (Sutherland and Hodgman).
Polygon clipped(const Polygon& polygon, const Vector2d& normal, double limit) {
  Polygon kept;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector2d &from = polygon[k], &to = polygon[(k + 1) % polygon.size()];
    const double before = normal.dot(from) - limit, after = normal.dot(to) - limit;
    if (before <= 0) kept.push_back(from);
    if ((before < 0 && after > 0) || (before > 0 && after < 0))
      kept.push_back(from + (to - from) * before / (before - after));
  }
  return kept;
}

Vector2d direction(int k) {
  const double angle = kPi * k / kDirections;
  return {std::cos(angle), std::sin(angle)};
}

/// The polygon bounded by a band's lower and upper limits in all directions.
Polygon between(const Band& band) {
  const double far = 4 * (1 + std::max(band.upper.maxCoeff(), -band.lower.minCoeff()));
  Polygon polygon = {{-far, -far}, {far, -far}, {far, far}, {-far, far}};
  for (int k = 0; k < kDirections; ++k) {
    polygon = clipped(polygon, direction(k), band.upper[k]);
    polygon = clipped(polygon, -direction(k), -band.lower[k]);
  }
  return polygon;
}

/// Mean of the responses and a square root of their covariance, kept invertible also where all
/// responses lie on a line.
struct Metric {
  Metric(const ArrayXd& re, const ArrayXd& im) : center(re.mean(), im.mean()) {
    Matrix2d covariance;
    covariance(0, 0) = (re - center[0]).square().mean();
    covariance(1, 1) = (im - center[1]).square().mean();
    covariance(0, 1) = covariance(1, 0) = ((re - center[0]) * (im - center[1])).mean();
    const Eigen::SelfAdjointEigenSolver<Matrix2d> eigen(covariance);
    const double least = 1e-12 * eigen.eigenvalues()[1] + 1e-24 * center.squaredNorm() + 1e-300;
    const Vector2d scales = eigen.eigenvalues().cwiseMax(least).cwiseSqrt();
    root = eigen.eigenvectors() * scales.asDiagonal();
    inverse = scales.cwiseInverse().asDiagonal() * eigen.eigenvectors().transpose();
  }

  Vector2d center;
  Matrix2d root, inverse;
};

/// Adds an independent error of the radius `by` in the complex plane to the limits in all
/// directions.
void widenAll(const Metric& metric, double by, Band* band) {
  for (int d = 0; d < kDirections; ++d)
    widen(0, by * (metric.inverse.transpose() * direction(d)).norm(), &band->lower[d],
          &band->upper[d]);
}

ComplexRegion regionOf(const Polygon& polygon, const Metric& metric, double omega, double level) {
  const auto corners = static_cast<Index>(polygon.size());
  ComplexRegion region{omega, level, Eigen::VectorXd(corners), Eigen::VectorXd(corners)};
  const bool mirrored = metric.root.determinant() < 0;
  for (Index k = 0; k < corners; ++k) {
    const Index from = mirrored ? corners - 1 - k : k;
    const Vector2d corner = metric.center + metric.root * polygon[static_cast<std::size_t>(from)];
    region.real[k] = corner[0];
    region.imaginary[k] = corner[1];
  }
  return region;
}

}  // namespace

std::vector<ComplexRegion> complexRegions(const PlantDistribution& plants,
                                          const Eigen::VectorXd& omega,
                                          const BoundsOptions& options, std::uint64_t seed) {
  const PlantSamples drawn =
      plants.draw(options.samples,
                  plants.hasEstimationErrors() ? Uncertainty::total : Uncertainty::mixture, seed);
  const ComplexResponses nominal = frequencyResponses(plants.nominal(), omega);
  ResponseSweep sweep(drawn);
  std::vector<ComplexRegion> regions;
  for (Index k = 0; k < omega.size(); ++k) {
    checkpoint();
    const ComplexResponses& all = sweep.at(omega.segment(k, 1));
    const std::complex<double> delay = std::polar(1.0, -omega[k] * drawn.sample_time * drawn.delay);
    const ArrayXd re = all.real.array() * delay.real() - all.imaginary.array() * delay.imag();
    const ArrayXd im = all.real.array() * delay.imag() + all.imaginary.array() * delay.real();
    const Metric metric(re, im);
    const ArrayXd x = metric.inverse(0, 0) * (re - metric.center[0]) +
                      metric.inverse(0, 1) * (im - metric.center[1]);
    const ArrayXd y = metric.inverse(1, 0) * (re - metric.center[0]) +
                      metric.inverse(1, 1) * (im - metric.center[1]);
    BandBuilder builder(options.levels, drawn.count(), kDirections, Sides::two, 1e-6F);
    for (int d = 0; d < kDirections; ++d)
      builder.add((x * direction(d)[0] + y * direction(d)[1]).cast<float>());
    const double gain = std::hypot(nominal.real(0, k), nominal.imaginary(0, k));
    for (Band& band : builder.bands().simultaneous) {
      const double by =
          gain * structureBound(plants.structureError(), omega.segment(k, 1), band.level)[0];
      if (by > 0) widenAll(metric, by, &band);
      regions.push_back(regionOf(between(band), metric, omega[k], band.level));
    }
  }
  return regions;
}

}  // namespace uncertainty_identification
