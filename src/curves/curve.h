#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>

#include "curves/place.h"
#include "curves/shape.h"

namespace uncertainty_identification {

/// A curve over equally spaced points with its derivatives by its parameters: one column per point,
/// [value; derivatives]. Between the points it is linear, beyond the ends constant.
struct CurveTable {
  Eigen::MatrixXd columns;
  double low = 0, per_unit = 0;  ///< first point; points per unit of z

  /// Column `left` and the share of the next one at z. Returns the slope of the value there.
  double locate(double z, int* left, double* share) const;
};

/// A curve at a place of the simulation, in standard deviations of the signals. It is free (hinges
/// at quantiles of what goes in, and a steep step at the physical zero), or has a shape.
class Curve {
 public:
  /// A width, a limit or the weights of plays: of places that are scalar.
  explicit Curve(Place place);
  /// `samples` are what goes into the curve, `zero` is added to them to count from the physical
  /// zero. `shape` null: a free curve. `covariate`: of places that read one.
  Curve(Place place, const Shape* shape, const Eigen::VectorXd& samples, double zero,
        std::string covariate = "");

  Place place() const { return place_; }
  const Shape* shape() const { return shape_; }
  const std::string& covariate() const { return covariate_; }
  bool isFree() const { return !shape_ && !isScalar(place_); }
  int parameters() const { return parameters_; }
  double zero() const { return zero_; }
  /// 400 quantiles of what goes in.
  const Eigen::VectorXd& samples() const { return samples_; }

  Eigen::VectorXd atSamples(const Eigen::VectorXd& parameters) const;
  /// At any z.
  Eigen::VectorXd at(const Eigen::VectorXd& z, const Eigen::VectorXd& parameters) const;
  /// d at(z) / d parameters.
  Eigen::MatrixXd derivatives(const Eigen::VectorXd& z, const Eigen::VectorXd& parameters) const;
  CurveTable table(const Eigen::VectorXd& parameters) const;
  /// What comes out at any z, both counted from the signal's offset: z and the curve. A whole shape
  /// that the input or a loop's error passes comes out as it is, with a slope of 1 between its
  /// limits or beyond its dead zone: the linear plant's gain belongs to that slope.
  Eigen::VectorXd characteristic(const Eigen::VectorXd& z, const Eigen::VectorXd& parameters) const;
  /// The curve without a shape, at the same place.
  Curve freed() const;
  /// The curve with a shape, at the same place.
  Curve shaped(const Shape* shape) const;
  /// Parameters of this free curve that come closest to `values` at the samples.
  Eigen::VectorXd closest(const Eigen::VectorXd& values) const;
  /// Whether the physical zero lies within the samples, widened by a twentieth of their range.
  bool coversZero() const;
  /// Constant, slope and scale by which a shape is made orthogonal to the linear plant:
  /// curve(z) = amplitude (value(z) - constant - slope z) / scale.
  struct Normalisation {
    double constant = 0, slope = 0, scale = 1;
  };
  Normalisation normalisation(const Eigen::VectorXd& parameters) const;

 private:
  void makeFree();
  Eigen::MatrixXd features(const Eigen::VectorXd& z) const;
  Eigen::MatrixXd linear(const Eigen::VectorXd& z) const;
  Eigen::VectorXd values(const Eigen::VectorXd& z, const double* shape_parameters) const;

  Place place_;
  const Shape* shape_ = nullptr;
  std::string covariate_;
  int parameters_ = 1;
  double zero_ = 0;
  double low_ = 0, high_ = 1;
  Eigen::VectorXd samples_;
  Eigen::MatrixXd projector_;  ///< pseudo-inverse of linear(samples_)
  // Of a free curve:
  Eigen::VectorXd knots_;
  bool has_slope_ = false;
  double step_width_ = 0;       ///< 0: no step at the physical zero
  Eigen::MatrixXd projection_;  ///< linear part of each feature
  Eigen::VectorXd scale_;
  std::shared_ptr<const Eigen::MatrixXd> basis_;  ///< features at the table's points
};

}  // namespace uncertainty_identification
