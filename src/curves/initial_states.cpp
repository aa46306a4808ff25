#include "curves/initial_states.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "curves/free_simulation.h"

namespace uncertainty_identification {
namespace {

/// The state of a plant at rest at the window's first samples.
Eigen::VectorXd stateAtRest(const CurveModel& model, const SimulationWindow& window) {
  const int n = model.order;
  Eigen::VectorXd state = Eigen::VectorXd::Zero(model.initialValues());
  state[0] = window.y[0];
  for (int i = 1; i < n; ++i)
    state[i] = -model.theta.segment(i, n - i).sum() * window.y[0] +
               model.theta.segment(n + i, n - i).sum() * window.u[0];
  return state;
}

SimulationWindow beginningOf(const SimulationWindow& whole, int length) {
  SimulationWindow window = whole;
  window.u.conservativeResize(length);
  window.y.conservativeResize(length);
  window.measured.conservativeResize(length);
  return window;
}

}  // namespace

std::vector<Eigen::VectorXd> initialStates(const SimulationData& data, const CurveModel& model,
                                           int samples, int iterations) {
  constexpr double kChange = 1e-3;
  const std::vector<CurveTable> tables = tablesOf(model);
  const bool is_linear = model.curves.empty();  // so that slopes stay what they are
  std::vector<Eigen::VectorXd> states;
  for (const SimulationWindow& whole : data.windows) {
    const int length = std::min(samples, whole.samples());
    SimulationWindow beginning;
    if (length < whole.samples()) beginning = beginningOf(whole, length);
    const SimulationWindow& window = length < whole.samples() ? beginning : whole;
    const auto residual = [&](const Eigen::VectorXd& from) -> Eigen::VectorXd {
      return window.measured *
             (window.y - simulateFreely(model, tables, window, from, false).y).array();
    };
    Eigen::VectorXd state = stateAtRest(model, whole), now = residual(state);
    Eigen::MatrixXd slopes(length, model.initialValues());
    double damping = 1e-2;
    for (int k = 0; k < iterations; ++k) {
      for (int i = 0; i < model.initialValues() && (k == 0 || !is_linear); ++i) {
        Eigen::VectorXd other = state;
        other[i] += kChange;
        slopes.col(i) = (now - residual(other)) / kChange;
      }
      Eigen::MatrixXd information = slopes.transpose() * slopes;
      information.diagonal() *= 1 + damping;
      information.diagonal().array() += 1e-6 * information.trace() + 1e-8;
      const Eigen::VectorXd next = state + information.ldlt().solve(slopes.transpose() * now);
      const Eigen::VectorXd after = residual(next);
      const bool is_better = after.squaredNorm() < now.squaredNorm();
      const bool is_done = is_better && after.squaredNorm() > 0.999 * now.squaredNorm();
      if (is_better) {
        state = next;
        now = after;
      }
      damping *= is_better ? 0.2 : 10;
      if (is_done) break;
    }
    states.push_back(state);
  }
  return states;
}

}  // namespace uncertainty_identification
