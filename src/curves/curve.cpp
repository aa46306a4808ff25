#include "curves/curve.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "curves/simulation_data.h"

namespace uncertainty_identification {
namespace {

constexpr int kPoints = 1024;
constexpr int kSamples = 400;

Eigen::VectorXd sortedDistinct(Eigen::VectorXd values) {
  values = (values * 1e6).array().round() / 1e6;
  std::sort(values.data(), values.data() + values.size());
  const auto end = std::unique(values.data(), values.data() + values.size());
  return values.head(end - values.data()).eval();
}

/// A value that occurs: between two levels of an input there is none.
double nearestQuantile(const Eigen::VectorXd& sorted, double share) {
  return sorted[static_cast<Eigen::Index>(
      std::lround(share * static_cast<double>(sorted.size() - 1)))];
}

double quantileOf(const Eigen::VectorXd& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto left = static_cast<Eigen::Index>(at);
  const Eigen::Index right = std::min<Eigen::Index>(left + 1, sorted.size() - 1);
  return sorted[left] + (at - static_cast<double>(left)) * (sorted[right] - sorted[left]);
}

/// Where a free curve bends: at quantiles, or at the levels of a signal that has few. Below the
/// lowest and above the highest level there is nothing to bend.
std::vector<double> knotsFor(const Eigen::VectorXd& sorted, const Eigen::VectorXd& levels) {
  constexpr Eigen::Index kFewLevels = 9;
  if (levels.size() <= kFewLevels)
    return levels.size() > 2
               ? std::vector<double>(levels.data() + 1, levels.data() + levels.size() - 1)
               : std::vector<double>{};
  const double range = sorted[sorted.size() - 1] - sorted[0] + 1e-9;
  std::vector<double> kept;
  for (const double share : {0.04, 0.15, 0.32, 0.5, 0.68, 0.85, 0.96}) {
    const double knot = quantileOf(sorted, share);
    if (kept.empty() || knot - kept.back() > 0.04 * range) kept.push_back(knot);
  }
  return kept;
}

}  // namespace

double CurveTable::locate(double z, int* left, double* share) const {
  const double end = static_cast<double>(columns.cols()) - 1.000001;
  const double raw = (z - low) * per_unit;
  const double position = std::min(std::max(raw, 0.0), end);
  *left = static_cast<int>(position);
  *share = position - *left;
  if (raw != position) return 0;
  return (columns(0, *left + 1) - columns(0, *left)) * per_unit;
}

Curve::Curve(Place place)
    : place_(place), parameters_(place == Place::input_hysteresis ? kPlays : 1) {}

Curve::Curve(Place place, const Shape* shape, const Eigen::VectorXd& samples, double zero,
             std::string covariate)
    : place_(place), shape_(shape), covariate_(std::move(covariate)), zero_(zero) {
  Eigen::VectorXd sorted = samples;
  std::sort(sorted.data(), sorted.data() + sorted.size());
  samples_.resize(kSamples);
  for (int k = 0; k < kSamples; ++k)
    samples_[k] = nearestQuantile(sorted, 0.002 + 0.996 * k / (kSamples - 1.0));
  const double range = samples_[kSamples - 1] - samples_[0] + 1e-9;
  low_ = samples_[0] - 0.5 * range;
  high_ = samples_[kSamples - 1] + 0.5 * range;
  projector_ = linear(samples_).completeOrthogonalDecomposition().pseudoInverse();
  if (shape)
    parameters_ = shape->count();
  else
    makeFree();
}

void Curve::makeFree() {
  const double range = samples_[kSamples - 1] - samples_[0] + 1e-9;
  const Eigen::VectorXd levels = sortedDistinct(samples_);
  const auto distinct = static_cast<int>(levels.size());
  parameters_ = 0;
  if (distinct <= 2 && linearPart(place_) == 2) return;
  const std::vector<double> kept = knotsFor(samples_, levels);
  knots_ = Eigen::Map<const Eigen::VectorXd>(kept.data(), static_cast<Eigen::Index>(kept.size()));
  has_slope_ = linearPart(place_) == 1;
  if (hasPhysicalZero(place_) && distinct > 4 && low_ + 0.1 * range < -zero_ &&
      -zero_ < high_ - 0.1 * range)
    step_width_ = 0.06 * std::sqrt((samples_.array() + zero_).square().mean());
  Eigen::MatrixXd at_samples = features(samples_);
  projection_ = projector_ * at_samples;
  at_samples -= linear(samples_) * projection_;
  scale_ = (at_samples.array().square().colwise().mean().sqrt() + 1e-9).inverse().transpose();
  parameters_ = static_cast<int>(scale_.size());
  const Eigen::VectorXd points = Eigen::VectorXd::LinSpaced(kPoints, low_, high_);
  basis_ = std::make_shared<const Eigen::MatrixXd>(
      (features(points) - linear(points) * projection_) * scale_.asDiagonal());
}

Eigen::MatrixXd Curve::features(const Eigen::VectorXd& z) const {
  const Eigen::Index extra = (has_slope_ ? 1 : 0) + (step_width_ > 0 ? 1 : 0);
  Eigen::MatrixXd all(z.size(), knots_.size() + extra);
  for (Eigen::Index k = 0; k < knots_.size(); ++k)
    all.col(k) = (z.array() - knots_[k]).max(0.0).matrix();
  Eigen::Index next = knots_.size();
  if (has_slope_) all.col(next++) = z;
  if (step_width_ > 0) all.col(next) = ((z.array() + zero_) / step_width_).tanh().matrix();
  return all;
}

Eigen::MatrixXd Curve::linear(const Eigen::VectorXd& z) const {
  Eigen::MatrixXd all = Eigen::MatrixXd::Ones(z.size(), linearPart(place_));
  if (linearPart(place_) == 2) all.col(1) = z;
  return all;
}

Eigen::VectorXd Curve::values(const Eigen::VectorXd& z, const double* shape_parameters) const {
  return z.unaryExpr([&](double each) { return shape_->value(each + zero_, shape_parameters); });
}

Curve::Normalisation Curve::normalisation(const Eigen::VectorXd& parameters) const {
  const double* shape_parameters = parameters.data() + (shape_->is_whole ? 0 : 1);
  const Eigen::VectorXd raw = values(samples_, shape_parameters);
  const Eigen::VectorXd part = projector_ * raw;
  Normalisation found;
  found.constant = part[0];
  found.slope = part.size() > 1 ? part[1] : 0;
  if (shape_->is_whole)
    found.scale = found.slope = std::abs(found.slope) > 0.05 ? found.slope : 0.05;
  else
    found.scale = std::sqrt((raw - linear(samples_) * part).array().square().mean()) + 1e-6;
  return found;
}

Eigen::VectorXd Curve::at(const Eigen::VectorXd& z, const Eigen::VectorXd& parameters) const {
  if (!shape_) {
    return (features(z) - linear(z) * projection_) * scale_.cwiseProduct(parameters);
  }
  const double* shape_parameters = parameters.data() + (shape_->is_whole ? 0 : 1);
  const Normalisation of = normalisation(parameters);
  const double amplitude = shape_->is_whole ? 1 : parameters[0];
  const Eigen::ArrayXd raw = values(z, shape_parameters).array() - of.constant;
  return (amplitude / of.scale * (raw - of.slope * z.array())).matrix();
}

Eigen::VectorXd Curve::characteristic(const Eigen::VectorXd& z,
                                      const Eigen::VectorXd& parameters) const {
  if (!shape_ || !shape_->is_whole || place_ == Place::sensor) return z + at(z, parameters);
  return (values(z, parameters.data()).array() - zero_).matrix();
}

Eigen::VectorXd Curve::atSamples(const Eigen::VectorXd& parameters) const {
  return at(samples_, parameters);
}

Eigen::MatrixXd Curve::derivatives(const Eigen::VectorXd& z,
                                   const Eigen::VectorXd& parameters) const {
  if (!shape_) return (features(z) - linear(z) * projection_) * scale_.asDiagonal();
  constexpr double kStep = 1e-4;
  Eigen::MatrixXd all(z.size(), parameters_);
  for (int j = 0; j < parameters_; ++j) {
    Eigen::VectorXd above = parameters, below = parameters;
    above[j] += kStep;
    below[j] -= kStep;
    all.col(j) = (at(z, above) - at(z, below)) / (2 * kStep);
  }
  return all;
}

CurveTable Curve::table(const Eigen::VectorXd& parameters) const {
  CurveTable made;
  made.low = low_;
  made.per_unit = (kPoints - 1) / (high_ - low_);
  made.columns.resize(parameters_ + 1, kPoints);
  const Eigen::VectorXd points = Eigen::VectorXd::LinSpaced(kPoints, low_, high_);
  made.columns.bottomRows(parameters_) =
      (basis_ ? *basis_ : derivatives(points, parameters)).transpose();
  made.columns.row(0) =
      (basis_ ? (*basis_ * parameters).eval() : at(points, parameters)).transpose();
  return made;
}

Curve Curve::freed() const { return Curve(place_, nullptr, samples_, zero_, covariate_); }

Curve Curve::shaped(const Shape* shape) const {
  return Curve(place_, shape, samples_, zero_, covariate_);
}

Eigen::VectorXd Curve::closest(const Eigen::VectorXd& values) const {
  const Eigen::MatrixXd basis = derivatives(samples_, {});
  const Eigen::MatrixXd ridge =
      1e-3 * kSamples * Eigen::MatrixXd::Identity(parameters_, parameters_);
  return (basis.transpose() * basis + ridge).ldlt().solve(basis.transpose() * values);
}

bool Curve::coversZero() const {
  constexpr double kMargin = 0.05;  // of the range
  const double low = samples_[0], high = samples_[kSamples - 1], margin = kMargin * (high - low);
  return low - margin <= -zero_ && -zero_ <= high + margin;
}

}  // namespace uncertainty_identification
