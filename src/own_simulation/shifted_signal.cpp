#include "own_simulation/shifted_signal.h"

#include <cmath>

namespace uncertainty_identification {
namespace {

/// Second derivatives m of the natural spline: m(k-1) + 4 m(k) + m(k+1) = 6 (s(k-1) - 2 s(k) +
/// s(k+1)), zero at both ends; by elimination in the tridiagonal system.
Eigen::VectorXd curvatureOf(const Eigen::VectorXd& s) {
  const Eigen::Index n = s.size();
  Eigen::VectorXd m = Eigen::VectorXd::Zero(n), factor = Eigen::VectorXd::Zero(n);
  for (Eigen::Index k = 1; k + 1 < n; ++k) {
    factor[k] = 1 / (4 - factor[k - 1]);
    m[k] = (6 * (s[k - 1] - 2 * s[k] + s[k + 1]) - m[k - 1]) * factor[k];
  }
  for (Eigen::Index k = n - 2; k > 0; --k) m[k] -= factor[k] * m[k + 1];
  return m;
}

}  // namespace

ShiftedSignal::ShiftedSignal(const Eigen::VectorXd& samples)
    : samples_(samples), curvature_(curvatureOf(samples)) {}

// All samples have the same place t between two samples, so each weight is one number.
ShiftedSignal::Part ShiftedSignal::delayed(double delay, Eigen::Index first,
                                           Eigen::Index last) const {
  const double whole = std::floor(-delay);
  const double t = -delay - whole, r = 1 - t;
  const Eigen::Index from = first + static_cast<Eigen::Index>(whole), count = last - first;
  const auto left = samples_.segment(from, count), right = samples_.segment(from + 1, count);
  const auto bent_left = curvature_.segment(from, count);
  const auto bent_right = curvature_.segment(from + 1, count);
  Part part;
  part.value =
      r * left + t * right + (r * r * r - r) / 6 * bent_left + (t * t * t - t) / 6 * bent_right;
  part.slope = right - left - (3 * r * r - 1) / 6 * bent_left + (3 * t * t - 1) / 6 * bent_right;
  return part;
}

}  // namespace uncertainty_identification
