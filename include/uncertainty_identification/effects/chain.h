#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "uncertainty_identification/model/block.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// A signal with a random amplitude in each experiment: z zeta_r, zeta_r ~ N(0, sigma^2 variance).
/// Where the output is not linear in zeta_r, it is linearised about a value of zeta_r in each
/// experiment, and z is the output's derivative there.
struct RandomSignal {
  Signals z;
  double variance = 0;          ///< relative to sigma^2
  Lanes about = Lanes::Zero();  ///< value of zeta_r that the output is linearised about
  Eigen::Index own_point = -1;  ///< row of Chain::points with the points; -1: linear in zeta_r
};

/// The signals of the physical chain for one block of experiments, which effects change stage by
/// stage. At its end, the model of the measurement is
///   y = x + sum_i xi_i X_i + sum_k zeta_k z_k + H omega,
/// with the error parameters xi, the random amplitudes zeta and the white noise omega. Where the
/// output is not linear in xi or zeta, these are the terms of its linearisation.
struct Chain {
  const Block& block;
  const NominalModel& nominal;
  Eigen::VectorXd theta;   ///< of the nominal model
  int experiments = 1;     ///< M, the number of experiments of the block's data set
  Eigen::MatrixXd points;  ///< what the output is linearised about, a column per lane: xi, then a
                           ///< row for each effect with a point of its own
  int regressors = 0;      ///< n, the number of the first rows of `points` that hold xi
  Eigen::Index own_point = -1;  ///< row of `points` that belongs to the effect being applied; -1
                                ///< where it has none

  Signals u;                ///< input of the plant
  Signals x;                ///< constant term of the linearisation: the output at xi = 0, zeta = 0
  std::vector<Signals> X;   ///< derivatives of the output with respect to xi, n of them
  Signals y;                ///< measurement with the sensor's dynamics inverted; empty: block.y
  Eigen::VectorXd noise_d;  ///< polynomial that multiplies D; monic, without the leading 1
  Signals deviation;        ///< standard deviation of the innovations over sigma; empty: 1
  Lanes log_jacobian = Lanes::Zero();  ///< log-determinant of the change from block.y to y
  std::vector<RandomSignal> random;

  /// The output at the point about which it is linearised.
  Signals expected() const;

  /// The points of the effect being applied, one per experiment.
  Lanes ownPoint() const { return points.row(own_point).transpose().array(); }

  /// Replaces the output by a function f of it, linearised about the point. `value` and `slope` are
  /// f and its derivative at expected().
  void transform(const Signals& value, const Signals& slope);

  /// Filters x, X and the random signals by numerator/denominator. The numerator has all its
  /// coefficients; the denominator is monic, without the leading 1.
  void filterOutput(const Eigen::VectorXd& numerator, const Eigen::VectorXd& denominator);

  /// Multiplies the standard deviation of the innovations.
  void scaleDeviation(const Signals& factor);

  /// Position in time of each experiment of the block, from -1/2 to 1/2. `starts` [s] are the
  /// rising starting times of the experiments to which the model was fitted: they are spaced
  /// evenly, and an experiment that begins between two of them is interpolated. If `starts` is
  /// empty, the position follows the order of the data set.
  Lanes positions(const Eigen::VectorXd& starts) const;

  /// A covariate as a signal, even where it is a constant; 0 for experiments without it.
  Signals covariate(const std::string& name) const;

  /// The row vector 0, 1, 2, ... of the block's samples.
  Eigen::Array<double, 1, Eigen::Dynamic> time() const;

  /// t/N at sample t of an experiment of N samples.
  Signals relativeTime() const;
};

/// x at the instants t + shift(t) [samples] between samples, by cubic Lagrange interpolation.
/// Beyond the ends, x keeps its first and last value.
Signals interpolated(const Signals& x, const Signals& shift);

/// The same with one shift for each lane.
Signals interpolated(const Signals& x, const Lanes& shift);

}  // namespace uncertainty_identification
