#include "curves/linear_simulation.h"

#include <algorithm>
#include <cmath>

#include "math/polynomial.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// The input of the plant: delayed, with its bias.
VectorXd inputOf(const CurveModel& model, const SimulationWindow& window) {
  const int samples = window.samples(), delay = std::min(model.delay, samples);
  VectorXd input(samples);
  input.head(delay).setConstant(window.u[0]);
  input.tail(samples - delay) = window.u.head(samples - delay);
  return (input.array() + model.theta[model.biasIndex()]).matrix();
}

/// The output without a level of its own, and the first state. False: the plant diverges.
bool simulate(const CurveModel& model, const VectorXd& input, const VectorXd& initial, VectorXd* y,
              VectorXd* first_state) {
  const int n = model.order;
  const double *a = model.theta.data(), *b = a + n, direct = model.directGain();
  VectorXd state = initial.head(n);
  for (Eigen::Index k = 0; k < input.size(); ++k) {
    const double output = state[0] + direct * input[k];
    (*first_state)[k] = state[0];
    (*y)[k] = output;
    for (int i = 0; i < n; ++i) {
      state[i] = (i + 1 < n ? state[i + 1] : 0) - a[i] * output + b[i] * input[k];
      if (!(std::abs(state[i]) <= kLargestState)) return false;
    }
  }
  return true;
}

/// By theta and the initial values: A(q) times each is a delayed signal.
Eigen::MatrixXd derivativesOf(const CurveModel& model, const VectorXd& input, const VectorXd& y) {
  const int n = model.order, first_initial = model.parameters();
  const VectorXd a = model.theta.head(n);
  const Eigen::Index samples = y.size();
  const VectorXd of_y = dividedBy(a, y), of_input = dividedBy(a, input),
                 of_one = dividedBy(a, VectorXd::Ones(samples)),
                 of_impulse = dividedBy(a, VectorXd::Unit(samples, 0));
  Eigen::MatrixXd by = Eigen::MatrixXd::Zero(first_initial + model.initialValues(), samples);
  for (Eigen::Index k = 0; k < samples; ++k) {
    for (int i = 0; i < n; ++i) {
      if (k >= i) by(first_initial + i, k) = of_impulse[k - i];
      if (k < i + 1) continue;
      by(i, k) = -of_y[k - 1 - i];
      by(n + i, k) = of_input[k - 1 - i];
      by(model.biasIndex(), k) += model.theta[n + i] * of_one[k - 1 - i];
    }
    if (!model.direct) continue;
    by(2 * n, k) = of_input[k];
    by(model.biasIndex(), k) += model.directGain() * of_one[k];
  }
  if (model.own_level) by.bottomRows(1).setOnes();
  return by;
}

}  // namespace

std::optional<FreeSimulation> simulateLinearly(const CurveModel& model,
                                               const SimulationWindow& window,
                                               const VectorXd& initial, bool with_derivatives) {
  FreeSimulation simulated;
  simulated.y.resize(window.samples());
  VectorXd first_state(window.samples());
  const VectorXd input = inputOf(model, window);
  if (!simulate(model, input, initial, &simulated.y, &first_state)) return std::nullopt;
  if (with_derivatives) simulated.derivatives = derivativesOf(model, input, simulated.y);
  simulated.rate.resize(window.samples());
  double previous = valueBefore(window);
  for (Eigen::Index k = 0; k < first_state.size(); ++k) {
    simulated.rate[k] = (first_state[k] - previous) / model.rate_scale;
    previous = first_state[k];
  }
  if (model.own_level) simulated.y.array() += initial[model.order];
  return simulated;
}

}  // namespace uncertainty_identification
