#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "curves/curve.h"

namespace uncertainty_identification {

/// A linear plant in observer form with curves around it, in standard deviations of the signals:
///
///     x_i(k+1) = x_{i+1}(k) - a_i y(k) + b_i w(k),   y = x_1 + b_0 w,
///
/// where w is the input with its curves, plus bias and what is fed back.
/// theta = [a (order), b (order), b_0 if direct, bias, parameters of each curve].
struct CurveModel {
  int order = 1;
  bool direct = false;
  int delay = 0;  ///< [samples] beyond the one that the plant has unless it is direct
  std::vector<Curve> curves;
  Eigen::VectorXd theta;
  double rate_scale = 1;   ///< one unit of the rate, per sample
  double input_zero = 0;   ///< added to u to count from the physical zero
  bool own_level = false;  ///< each window's output is counted from a level of its own
  /// State at the beginning of each window, and its level if there is one; empty: unknown.
  std::vector<Eigen::VectorXd> initial;

  /// Number of unknowns of each window.
  int initialValues() const { return order + (own_level ? 1 : 0); }
  /// From which the output of a window is counted.
  double levelOf(std::size_t window) const { return own_level ? initial[window][order] : 0; }
  int linearParameters() const { return 2 * order + (direct ? 1 : 0) + 1; }
  int biasIndex() const { return 2 * order + (direct ? 1 : 0); }
  double directGain() const { return direct ? theta[2 * order] : 0; }
  int parameters() const { return static_cast<int>(theta.size()); }
  /// Index in theta of the first parameter of a curve.
  int firstOf(std::size_t curve) const {
    int first = linearParameters();
    for (std::size_t k = 0; k < curve; ++k) first += curves[k].parameters();
    return first;
  }
  Eigen::VectorXd parametersOf(std::size_t curve) const {
    return theta.segment(firstOf(curve), curves[curve].parameters());
  }
  /// Sum of b, kept away from zero.
  double sumOfB() const {
    constexpr double kLeast = 1e-9;
    const double sum = theta.segment(order, order).sum();
    return std::abs(sum) < kLeast ? kLeast : sum;
  }
  /// The input that holds one unit of the output; 0 of a plant that integrates.
  double inverseGain() const { return (1 + theta.head(order).sum()) / sumOfB(); }
  bool has(Place place) const {
    for (const Curve& curve : curves)
      if (curve.place() == place) return true;
    return false;
  }
};

}  // namespace uncertainty_identification
