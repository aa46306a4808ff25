#pragma once

#include <Eigen/Core>
#include <optional>

#include "own_simulation/correlated_regression.h"
#include "own_simulation/shifted_signal.h"

namespace uncertainty_identification {

/// The whole shift [samples], within +-most, at which y is closest to bias + gain y_sim. A larger
/// shift must lower the squared error by 1 %, so that periodic signals are shifted least. Of long
/// records evenly spaced samples are compared.
int bestShift(const Eigen::VectorXd& y, const Eigen::ArrayXd& weight, const Eigen::VectorXd& y_sim,
              int most);

struct DelayedRegression {
  double delay = 0;      ///< [samples]
  Regression of_slopes;  ///< of y on 1, y_sim(t - delay) and its derivative, whose coefficient is 0
};

/// Bias, gain and delay [samples] by Gauss and Newton's method from `start`. Nothing where it does
/// not converge within +-most, or where the derivative of y_sim is a combination of 1 and y_sim.
std::optional<DelayedRegression> regressDelayed(const Eigen::VectorXd& y,
                                                const Eigen::ArrayXd& weight,
                                                const ShiftedSignal& y_sim, int start, int most);

}  // namespace uncertainty_identification
