#pragma once

#include <cmath>

#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification::test {

/// A heater whose input a PID controller computes from its readings, which are rounded and have no
/// noise that correlations at lags would see.
inline Experiment heaterUnderControl() {
  constexpr int kSamples = 126;
  Experiment experiment;
  experiment.id = "heater";
  experiment.sample_time = 0.25;
  experiment.u = experiment.y = Eigen::VectorXd::Zero(kSamples);
  double temperature = 24.4, sum = 0, before = 24.4;
  for (int k = 0; k < kSamples; ++k) {
    experiment.y(k) = std::round(1000 * temperature) / 1000;
    const double error = 26 - experiment.y(k);
    sum += 0.25 * error;
    experiment.u(k) = 20 * error + 2 * sum - 5 * (experiment.y(k) - before) / 0.25;
    before = experiment.y(k);
    temperature += 0.25 * (0.02 * experiment.u(k) - 0.01 * (temperature - 20));
  }
  return experiment;
}

}  // namespace uncertainty_identification::test
