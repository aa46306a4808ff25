#include "curves/simulation_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "curves/window_products.h"
#include "math/polynomial.h"

namespace uncertainty_identification {
namespace {

constexpr double kHopeless = 1e30;  ///< error of a model that cannot be simulated
constexpr int kManyGroups = 16;     ///< from which the groups themselves give a standard error

/// All windows' products at one theta, and their sums.
struct Linearisation {
  std::vector<WindowProducts> windows;
  WindowProducts::Block sum;  ///< projected
  double squared_error = 0;   ///< before projection
};

int blocksOf(const SimulationData& data) {
  if (static_cast<int>(data.groups.size()) - 1 >= kManyGroups) return 1;
  return std::min(3, std::max(1, data.longest / 50));
}

Linearisation linearise(const SimulationData& data, const CurveModel& model) {
  const std::vector<CurveTable> tables = tablesOf(model);
  Linearisation at;
  for (std::size_t w = 0; w < data.windows.size(); ++w) {
    at.windows.push_back(
        productsOf(model, tables, data.windows[w], model.initial[w], blocksOf(data)));
    at.squared_error += at.windows.back().squared_error;
    const WindowProducts::Block total = at.windows.back().total();
    if (w == 0) {
      at.sum = total;
    } else {
      at.sum.jj += total.jj;
      at.sum.jr += total.jr;
      at.sum.rr += total.rr;
    }
  }
  if (!at.sum.jj.allFinite()) at.squared_error = kHopeless;
  return at;
}

/// Precision of the ridge prior of free curves: a deviation of a twentieth of the output's where
/// the error is a quarter of it.
Eigen::VectorXd priorPrecision(const CurveModel& model, double squared_error, int samples) {
  Eigen::VectorXd precision = Eigen::VectorXd::Zero(model.parameters());
  for (std::size_t c = 0; c < model.curves.size(); ++c)
    if (model.curves[c].isFree())
      precision.segment(model.firstOf(c), model.curves[c].parameters())
          .setConstant(80 * squared_error / samples);
  return precision;
}

Eigen::VectorXd solved(Eigen::MatrixXd matrix, const Eigen::VectorXd& right) {
  if (!matrix.allFinite() || !right.allFinite()) return Eigen::VectorXd::Zero(right.size());
  return matrix.partialPivLu().solve(right);
}

/// The model with theta moved by `step` and each initial state by what follows from it.
CurveModel moved(const CurveModel& from, const Linearisation& at, const Eigen::VectorXd& step) {
  CurveModel to = from;
  to.theta += step;
  for (std::size_t w = 0; w < at.windows.size(); ++w) {
    const WindowProducts& window = at.windows[w];
    Eigen::MatrixXd xx = window.xx;
    xx.diagonal().array() += 1e-6 * xx.trace() + 1e-10;
    to.initial[w] += solved(xx, window.xr - window.xj * step);
  }
  return to;
}

Eigen::MatrixXd ridged(const Eigen::MatrixXd& information, const Eigen::VectorXd& prior) {
  Eigen::MatrixXd ridge = (1e-5 * information.diagonal() + prior).asDiagonal();
  ridge.diagonal().array() +=
      1e-7 * information.trace() / static_cast<double>(information.rows()) + 1e-12;
  return ridge;
}

/// Exact leave-one-group-out of the linearised fit: theta without a group differs by
/// (H - H_g + R)^-1 g_g.
void leaveGroupsOut(const SimulationData& data, const Linearisation& at, SimulationFit* fit) {
  const Eigen::MatrixXd& information = at.sum.jj;
  const Eigen::MatrixXd ridge =
      ridged(information, priorPrecision(fit->model, at.sum.rr, data.samples));
  const Eigen::VectorXd step =
      fit->step.size() ? fit->step : Eigen::VectorXd::Zero(information.rows());
  Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(information.rows(), information.cols());
  const bool many = static_cast<int>(data.groups.size()) - 1 >= kManyGroups;
  std::vector<double> parts;
  fit->squared_error = fit->left_out = 0;
  for (std::size_t g = 0; g + 1 < data.groups.size(); ++g) {
    Eigen::MatrixXd rest = information + ridge;
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(information.rows());
    for (int w = data.groups[g]; w < data.groups[g + 1]; ++w) {
      const WindowProducts::Block own = at.windows[static_cast<std::size_t>(w)].total();
      rest -= own.jj;
      gradient += own.jr - own.jj * step;
      fit->squared_error += errorAfter(own, step);
    }
    spread += gradient * gradient.transpose();
    const Eigen::VectorXd without = step - solved(rest, gradient);
    double of_group = 0;
    for (int w = data.groups[g]; w < data.groups[g + 1]; ++w) {
      for (const WindowProducts::Block& block : at.windows[static_cast<std::size_t>(w)].blocks) {
        const double error = errorAfter(block, without);
        of_group += error;
        if (!many) parts.push_back(error);
      }
    }
    if (many) parts.push_back(of_group);
    fit->left_out += of_group;
  }
  if (!std::isfinite(fit->left_out)) fit->left_out = kHopeless;
  if (!std::isfinite(fit->squared_error)) fit->squared_error = kHopeless;
  fit->left_out_of =
      Eigen::Map<Eigen::VectorXd>(parts.data(), static_cast<Eigen::Index>(parts.size()));
  const Eigen::MatrixXd inverse = (information + ridge).inverse();
  const auto groups = static_cast<double>(data.groups.size() - 1);
  fit->covariance = groups / std::max(groups - 1, 1.0) * (inverse * spread * inverse);
}

SimulationFit concluded(const SimulationData& data, CurveModel model, const Linearisation& at,
                        Eigen::VectorXd step) {
  SimulationFit fit;
  fit.model = std::move(model);
  fit.step = std::move(step);
  leaveGroupsOut(data, at, &fit);
  for (const WindowProducts& window : at.windows) fit.residuals.push_back(window.residual);
  return fit;
}

double priorTerm(const Eigen::VectorXd& precision, const Eigen::VectorXd& theta) {
  return precision.dot(theta.cwiseAbs2());
}

/// Looks for a step that lowers the error. Returns whether there is one.
bool improve(const SimulationData& data, const Linearisation& at, double* damping, double* error,
             CurveModel* model) {
  const Eigen::VectorXd prior = priorPrecision(*model, *error, data.samples);
  const Eigen::VectorXd gradient = at.sum.jr - prior.cwiseProduct(model->theta);
  Eigen::MatrixXd information = at.sum.jj;
  information.diagonal() += prior;
  const Eigen::VectorXd scale = information.diagonal().array() +
                                1e-6 * information.trace() / static_cast<double>(gradient.size());
  const double now = *error + priorTerm(prior, model->theta);
  for (int attempt = 0; attempt < 5; ++attempt) {
    Eigen::MatrixXd damped = information;
    damped.diagonal() += *damping * scale;
    const Eigen::VectorXd step = solved(damped, gradient);
    CurveModel candidate = moved(*model, at, step);
    if (isSimulable(candidate)) {
      const double reached = simulationError(data, candidate);
      if (reached + priorTerm(prior, candidate.theta) < now) {
        *model = std::move(candidate);
        *error = reached;
        return true;
      }
    }
    *damping = std::max(*damping, 1e-4) * 8;
  }
  return false;
}

/// The state of a plant at rest at the window's first samples.
Eigen::VectorXd stateAtRest(const CurveModel& model, const SimulationWindow& window) {
  const int n = model.order;
  Eigen::VectorXd state(n);
  state[0] = window.y[0];
  for (int i = 1; i < n; ++i)
    state[i] = -model.theta.segment(i, n - i).sum() * window.y[0] +
               model.theta.segment(n + i, n - i).sum() * window.u[0];
  return state;
}

}  // namespace

bool isSimulable(const CurveModel& model) {
  const bool fed_back = std::any_of(model.curves.begin(), model.curves.end(),
                                    [](const Curve& curve) { return isFedBack(curve.place()); });
  return model.theta.allFinite() &&
         isStable(model.theta.head(model.order), fed_back ? 1.02 : 1.0005);
}

std::vector<Eigen::VectorXd> initialStates(const SimulationData& data, const CurveModel& model,
                                           int samples, int iterations) {
  constexpr double kChange = 1e-3;
  const std::vector<CurveTable> tables = tablesOf(model);
  std::vector<Eigen::VectorXd> states;
  for (const SimulationWindow& whole : data.windows) {
    SimulationWindow window = whole;
    const int length = std::min(samples, whole.samples());
    window.u.conservativeResize(length);
    window.y.conservativeResize(length);
    window.measured.conservativeResize(length);
    const auto residual = [&](const Eigen::VectorXd& from) -> Eigen::VectorXd {
      return window.measured *
             (window.y - simulateFreely(model, tables, window, from, false).y).array();
    };
    Eigen::VectorXd state = stateAtRest(model, whole), now = residual(state);
    double damping = 1e-2;
    for (int k = 0; k < iterations; ++k) {
      Eigen::MatrixXd slopes(length, model.order);
      for (int i = 0; i < model.order; ++i) {
        Eigen::VectorXd other = state;
        other[i] += kChange;
        slopes.col(i) = (now - residual(other)) / kChange;
      }
      Eigen::MatrixXd information = slopes.transpose() * slopes;
      information.diagonal() *= 1 + damping;
      information.diagonal().array() += 1e-6 * information.trace() + 1e-8;
      const Eigen::VectorXd next = state + solved(information, slopes.transpose() * now);
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

double simulationError(const SimulationData& data, const CurveModel& model) {
  const std::vector<CurveTable> tables = tablesOf(model);
  double sum = 0;
  for (std::size_t w = 0; w < data.windows.size(); ++w) {
    const SimulationWindow& window = data.windows[w];
    const FreeSimulation simulated = simulateFreely(model, tables, window, model.initial[w], false);
    sum += (window.measured * (window.y - simulated.y).array().square()).sum();
  }
  return std::isfinite(sum) ? sum : kHopeless;
}

SimulationFit fitFreely(const SimulationData& data, CurveModel model, const FitLimits& limits) {
  if (model.initial.size() != data.windows.size() || model.initial.front().size() != model.order)
    model.initial = initialStates(data, model, data.longest);
  Linearisation at = linearise(data, model);
  double error = at.squared_error, damping = 1e-3;
  int small = 0;
  for (int k = 0; k < limits.iterations && small < 2; ++k) {
    if (limits.going_on && !limits.going_on()) break;
    const double before = error;
    if (!improve(data, at, &damping, &error, &model)) break;
    small = before - error < limits.tolerance * before ? small + 1 : 0;
    damping = std::max(damping / 6, 1e-7);
    at = linearise(data, model);
    error = at.squared_error;
  }
  return concluded(data, std::move(model), at, {});
}

SimulationFit stepLinearly(const SimulationData& data, const CurveModel& model) {
  const Linearisation at = linearise(data, model);
  const Eigen::MatrixXd ridge = ridged(at.sum.jj, priorPrecision(model, at.sum.rr, data.samples));
  return concluded(data, model, at, solved(at.sum.jj + ridge, at.sum.jr));
}

double effectiveSamples(const SimulationFit& fit) {
  Eigen::Index longest = 0;
  double power = 0, samples = 0;
  for (const Eigen::VectorXd& residual : fit.residuals) {
    longest = std::max(longest, residual.size());
    power += residual.squaredNorm();
    samples += static_cast<double>(residual.size());
  }
  double time = 1;
  for (Eigen::Index lag = 1; lag < std::min<Eigen::Index>(200, longest / 2); ++lag) {
    double product = 0;
    for (const Eigen::VectorXd& residual : fit.residuals) {
      const Eigen::Index pairs = residual.size() - lag;
      if (pairs > 0) product += residual.head(pairs).dot(residual.tail(pairs));
    }
    if (product < 0.05 * power) break;
    time += 2 * product / power;
  }
  return samples / time;
}

double criterion(const SimulationFit& fit, double effective_samples) {
  double samples = 0;
  for (const Eigen::VectorXd& residual : fit.residuals)
    samples += static_cast<double>(residual.size());
  return effective_samples * std::log(fit.squared_error / samples) +
         fit.parameters() * std::log(std::max(effective_samples, 8.0));
}

double pairedT(const SimulationFit& before, const SimulationFit& after) {
  const auto t = [](const Eigen::ArrayXd& gains) {
    const auto count = static_cast<double>(gains.size());
    const double mean = gains.mean();
    const double variance = (gains - mean).square().sum() / std::max(count - 1, 1.0);
    return mean / (std::sqrt(variance / count) + 1e-12);
  };
  const Eigen::ArrayXd worse = before.left_out_of.array(), better = after.left_out_of.array();
  return std::max(t(worse - better), t(((worse + 1e-12) / (better + 1e-12)).log()));
}

}  // namespace uncertainty_identification
