#include "curves/window_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "curves/initial_states.h"
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

Eigen::VectorXd solved(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
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
void leaveGroupsOut(const SimulationData& data, const Linearisation& at, WindowFit* fit) {
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
      const WindowProducts& window = at.windows[static_cast<std::size_t>(w)];
      for (const WindowProducts::Block& block : window.blocks) {
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

WindowFit concluded(const SimulationData& data, CurveModel model, const Linearisation& at,
                    Eigen::VectorXd step) {
  WindowFit fit;
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

}  // namespace

bool isSimulable(const CurveModel& model) {
  const bool fed_back = std::any_of(model.curves.begin(), model.curves.end(),
                                    [](const Curve& curve) { return isFedBack(curve.place()); });
  return model.theta.allFinite() &&
         isStable(model.theta.head(model.order), fed_back ? 1.02 : 1.0005);
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

WindowFit fitFreely(const SimulationData& data, CurveModel model, const FitLimits& limits) {
  if (model.initial.size() != data.windows.size() ||
      model.initial.front().size() != model.initialValues())
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

std::vector<Eigen::VectorXd> thetaWithout(const SimulationData& data, const WindowFit& fit,
                                          const std::vector<std::vector<int>>& windows) {
  const Linearisation at = linearise(data, fit.model);
  const Eigen::MatrixXd information =
      at.sum.jj + ridged(at.sum.jj, priorPrecision(fit.model, at.sum.rr, data.samples));
  std::vector<Eigen::VectorXd> all;
  all.reserve(windows.size());
  for (const std::vector<int>& together : windows) {
    Eigen::MatrixXd rest = information;
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(rest.rows());
    for (const int w : together) {
      const WindowProducts::Block own = at.windows[static_cast<std::size_t>(w)].total();
      rest -= own.jj;
      gradient += own.jr;
    }
    all.push_back(fit.model.theta - solved(rest, gradient));
  }
  return all;
}

WindowFit stepLinearly(const SimulationData& data, const CurveModel& model) {
  const Linearisation at = linearise(data, model);
  const Eigen::MatrixXd ridge = ridged(at.sum.jj, priorPrecision(model, at.sum.rr, data.samples));
  return concluded(data, model, at, solved(at.sum.jj + ridge, at.sum.jr));
}

}  // namespace uncertainty_identification
