#pragma once

#include <Eigen/Core>

namespace uncertainty_identification {

/// A signal on a uniform grid, interpolated by the natural cubic spline through its samples, so
/// that it can be delayed by parts of a sample.
class ShiftedSignal {
 public:
  /// Values of the delayed signal and their derivative with respect to time in samples.
  struct Part {
    Eigen::VectorXd value, slope;
  };

  /// `samples`: N >= 2 finite values [unit of the signal].
  explicit ShiftedSignal(const Eigen::VectorXd& samples);

  /// The samples `first` <= k < `last` of the signal that is `delay` [samples] late, which may be
  /// negative. All k - delay must lie within [0, N - 1).
  Part delayed(double delay, Eigen::Index first, Eigen::Index last) const;

  const Eigen::VectorXd& samples() const { return samples_; }

 private:
  Eigen::VectorXd samples_, curvature_;  // values and second derivatives at the samples
};

}  // namespace uncertainty_identification
