#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "uncertainty_identification/model/block.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// A signal with a random amplitude in each experiment: z zeta_r, zeta_r ~ N(0, sigma^2 variance).
struct RandomSignal {
  Signals z;
  double variance = 0;          ///< relative to sigma^2
  Lanes about = Lanes::Zero();  ///< zeta_r that z is the derivative at, where x depends on it
                                ///< nonlinearly
  Eigen::Index own_point = -1;  ///< and the row of Chain::points that tells where that is
};

/// What flows through the physical chain for one block of experiments, and what effects change:
///   y = x + sum_i xi_i X_i + sum_k zeta_k z_k + H omega.
struct Chain {
  const Block& block;
  const NominalModel& nominal;
  Eigen::VectorXd theta;   ///< of the nominal model
  int experiments = 1;     ///< M of the data set the block is of
  Eigen::MatrixXd points;  ///< xi that is linearised about, then a row for each effect with a point
                           ///< of its own; a column per lane
  int regressors = 0;      ///< n, the first rows of `points`
  Eigen::Index own_point = -1;  ///< row of `points` of the effect that acts

  Signals u;                ///< what drives the plant
  Signals x;                ///< output where xi and zeta are 0, by linearisation about the point
  std::vector<Signals> X;   ///< its n derivatives to xi
  Signals y;                ///< measurement, sensor dynamics undone; empty: block.y
  Eigen::VectorXd noise_d;  ///< factor of D, monic, without the leading 1
  Signals deviation;        ///< of the innovations, relative to sigma; empty: 1
  Lanes log_jacobian = Lanes::Zero();  ///< of what was done to y
  std::vector<RandomSignal> random;

  /// x at the point.
  Signals expected() const;

  /// What the effect that acts is linearised about, in each experiment.
  Lanes ownPoint() const { return points.row(own_point).transpose().array(); }

  /// Sets x to f(x), and X and random signals to f'(x) times what they were, linearised about the
  /// point: `value` and `slope` at expected().
  void transform(const Signals& value, const Signals& slope);

  /// Puts x, X and random signals, as far as they are there, through numerator/denominator (all
  /// coefficients; monic without the leading 1).
  void filterOutput(const Eigen::VectorXd& numerator, const Eigen::VectorXd& denominator);

  /// Multiplies the innovations' deviation.
  void scaleDeviation(const Signals& factor);

  /// Position of each experiment among those that began at `starts` [s, rising], the first at -1/2,
  /// the last at 1/2: others by their own beginning, between the two that it falls between. Without
  /// starts its position in the order of its own data set.
  Lanes positions(const Eigen::VectorXd& starts) const;

  /// A covariate as a signal, where it is constant too; 0 for experiments without it.
  Signals covariate(const std::string& name) const;

  /// Row vector 0, 1, 2, ... as far as the block goes.
  Eigen::Array<double, 1, Eigen::Dynamic> time() const;

  /// Time as a share of each experiment's length, 0 to 1.
  Signals relativeTime() const;
};

/// x at fractional sampling instants t + shift(t), by cubic Lagrange interpolation.
Signals interpolated(const Signals& x, const Signals& shift);

/// The same with one shift for each lane.
Signals interpolated(const Signals& x, const Lanes& shift);

}  // namespace uncertainty_identification
