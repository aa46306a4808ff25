#include <cmath>

#include "chain.h"
#include "signals.h"

namespace uncertainty_identification {
namespace {

/// Stationary first-order noise of unit variance with this time constant [samples].
Eigen::VectorXd wandering(int samples, double time_constant, std::mt19937_64& random) {
  const double pole = std::exp(-1 / time_constant);
  Eigen::VectorXd steps = gaussian(samples, 1, random);
  steps.tail(samples - 1) *= std::sqrt(1 - pole * pole);
  return filtered(Eigen::VectorXd::Ones(1), Eigen::VectorXd::Constant(1, -pole), 0, steps);
}

}  // namespace

Eigen::VectorXd temperature(int samples, std::mt19937_64 random) {
  const double level = 20 + 5 * gaussian(1, 1, random)(0);
  return (level + 3 * wandering(samples, 100, random).array()).matrix();
}

Eigen::VectorXd secondInput(int samples, std::mt19937_64 random) {
  return wandering(samples, 3, random);
}

}  // namespace uncertainty_identification
