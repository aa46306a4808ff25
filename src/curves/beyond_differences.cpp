#include "curves/beyond_differences.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "curves/free_simulation.h"
#include "curves/initial_states.h"
#include "curves/starts.h"
#include "curves/window_products.h"
#include "math/polynomial.h"

namespace uncertainty_identification {
namespace {

constexpr double kDiverged = 1e6;  ///< error of a simulation that diverges

enum class Differ { in_gain_and_offset, in_linear_plant };

/// A record of one plant among several may have another linear plant, but for records of a single
/// step, which would leave nothing to tell a curve by. Thinning leaves two changes of a step.
Differ differOf(const SimulationData& record, bool of_several) {
  constexpr int kOfAStep = 2;
  int changes = 0;
  for (const SimulationWindow& window : record.windows) changes += changesOf(window.u);
  return of_several && changes > kOfAStep ? Differ::in_linear_plant : Differ::in_gain_and_offset;
}

/// The changes of theta by which records may differ.
Eigen::MatrixXd directionsOf(const CurveModel& model, Differ differ) {
  const int n = model.order;
  if (differ == Differ::in_linear_plant)
    return Eigen::MatrixXd::Identity(model.parameters(), model.linearParameters());
  Eigen::MatrixXd changes = Eigen::MatrixXd::Zero(model.parameters(), 2);
  changes.col(0).segment(n, n) = model.theta.segment(n, n);
  if (model.direct) changes(2 * n, 0) = model.directGain();
  changes(model.biasIndex(), 1) = 1;
  return changes;
}

std::vector<WindowProducts> productsOf(const SimulationData& record, const CurveModel& model) {
  const std::vector<CurveTable> tables = tablesOf(model);
  std::vector<WindowProducts> all;
  all.reserve(record.windows.size());
  for (std::size_t w = 0; w < record.windows.size(); ++w)
    all.push_back(productsOf(model, tables, record.windows[w], model.initial[w], 1));
  return all;
}

double sumOf(const std::vector<WindowProducts>& products) {
  double sum = 0;
  for (const WindowProducts& each : products) sum += each.blocks.front().rr;
  return std::isfinite(sum) ? sum : kDiverged;
}

/// The step of theta, by Levenberg and Marquardt, to what is the record's own.
Eigen::VectorXd stepOf(const CurveModel& model, const std::vector<WindowProducts>& products,
                       Differ differ, double damping) {
  const Eigen::MatrixXd own = directionsOf(model, differ);
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(own.cols());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(own.cols(), own.cols());
  for (const WindowProducts& window : products) {
    gradient += own.transpose() * window.blocks.front().jr;
    information += own.transpose() * window.blocks.front().jj * own;
  }
  information.diagonal() *= 1 + damping;
  information.diagonal().array() += 1e-9 * information.trace() + 1e-12;
  return own * information.ldlt().solve(gradient);
}

/// The model that step further.
CurveModel moved(CurveModel model, const std::vector<WindowProducts>& products,
                 const Eigen::VectorXd& step) {
  model.theta += step;
  if (!isSimulable(model))
    model.theta.head(model.order) = stabilised(model.theta.head(model.order));
  for (std::size_t k = 0; k < products.size(); ++k) {
    Eigen::MatrixXd xx = products[k].xx;
    xx.diagonal().array() += 1e-6 * xx.trace() + 1e-10;
    model.initial[k] += xx.ldlt().solve(products[k].xr - products[k].xj * step);
  }
  return model;
}

/// Products of the record's windows once a linear plant of its own is fitted, from this model on.
std::vector<WindowProducts> fittedFrom(CurveModel model, const SimulationData& record) {
  constexpr int kSteps = 30;
  constexpr double kProgress = 1e-3, kHopeless = 1e6;
  std::vector<WindowProducts> products = productsOf(record, model);
  double damping = 1e-3;
  int small = 0;
  for (int k = 0; k < kSteps && small < 2 && damping < kHopeless; ++k) {
    CurveModel next =
        moved(model, products, stepOf(model, products, Differ::in_linear_plant, damping));
    std::vector<WindowProducts> after;
    if (isSimulable(next)) after = productsOf(record, next);
    const double before = sumOf(products), error = after.empty() ? kDiverged : sumOf(after);
    const bool is_better = error < before;
    damping *= is_better ? 0.2 : 10;
    if (!is_better) continue;
    small = error > (1 - kProgress) * before ? small + 1 : 0;
    model = std::move(next);
    products = std::move(after);
  }
  return products;
}

/// The better of the fits from this model and from a linear start of the record's own, since
/// records may differ much.
std::vector<WindowProducts> ofOwnPlant(const SimulationData& record, const CurveModel& model) {
  std::vector<WindowProducts> best = fittedFrom(model, record);
  CurveModel own = model;
  own.theta.head(own.linearParameters()) =
      linearStart(record, model.order, model.direct, model.delay).theta;
  own.initial = initialStates(record, own, record.longest);
  std::vector<WindowProducts> other = fittedFrom(std::move(own), record);
  return sumOf(other) < sumOf(best) ? other : best;
}

/// Squared error of each window of the record. A gain and an offset are fitted in one step.
std::vector<double> errorsOf(const SimulationData& record, const CurveModel& model,
                             bool of_several) {
  Eigen::VectorXd step = Eigen::VectorXd::Zero(model.parameters());
  std::vector<WindowProducts> products;
  if (differOf(record, of_several) == Differ::in_linear_plant) {
    products = ofOwnPlant(record, model);
  } else {
    products = productsOf(record, model);
    step = stepOf(model, products, Differ::in_gain_and_offset, 0);
  }
  std::vector<double> errors;
  errors.reserve(products.size());
  for (const WindowProducts& window : products) {
    const double error = errorAfter(window.blocks.front(), step);
    errors.push_back(std::isfinite(error) ? error : kDiverged);
  }
  return errors;
}

/// The model with the initial states of some windows only.
CurveModel ofWindows(CurveModel model, const std::vector<Eigen::VectorXd>& initial,
                     const std::vector<int>& windows) {
  model.initial.clear();
  for (const int w : windows) model.initial.push_back(initial[static_cast<std::size_t>(w)]);
  return model;
}

}  // namespace

Eigen::VectorXd errorsBeyondDifferences(const SimulationData& held, const CurveModel& model) {
  if (std::all_of(held.windows.begin(), held.windows.end(),
                  [](const SimulationWindow& window) { return changesOf(window.u) <= 1; }))
    return {};
  const std::vector<Eigen::VectorXd> initial = initialStates(held, model, held.longest);
  const std::vector<std::vector<int>> records = windowsByRecord(held);
  Eigen::VectorXd errors(static_cast<Eigen::Index>(held.windows.size()));
  for (const std::vector<int>& windows : records) {
    const std::vector<double> own =
        errorsOf(onlyOf(held, windows), ofWindows(model, initial, windows), records.size() > 1);
    for (std::size_t k = 0; k < windows.size(); ++k) errors[windows[k]] = own[k];
  }
  return errors;
}

Eigen::VectorXd leftOutBeyondDifferences(const SimulationData& data, const WindowFit& fit) {
  std::vector<std::vector<int>> left_out_together = windowsByRecord(data);
  const bool are_several = left_out_together.size() > 1;
  if (!are_several) {
    left_out_together.clear();
    for (std::size_t w = 0; w < data.windows.size(); ++w)
      left_out_together.push_back({static_cast<int>(w)});
  }
  const std::vector<Eigen::VectorXd> theta = thetaWithout(data, fit, left_out_together);
  Eigen::VectorXd errors(static_cast<Eigen::Index>(data.windows.size()));
  for (std::size_t r = 0; r < theta.size(); ++r) {
    const std::vector<int>& windows = left_out_together[r];
    CurveModel model = ofWindows(fit.model, fit.model.initial, windows);
    model.theta = theta[r];
    const std::vector<double> own = errorsOf(onlyOf(data, windows), model, are_several);
    for (std::size_t k = 0; k < windows.size(); ++k) errors[windows[k]] = own[k];
  }
  return errors;
}

bool showDifferences(const SimulationData& data, const SimulationData& held) {
  constexpr std::size_t kFewWindows = 4;
  const auto are_of_several = [](const SimulationData& of) {
    return std::any_of(of.windows.begin(), of.windows.end(), [&](const SimulationWindow& window) {
      return window.record != of.windows.front().record;
    });
  };
  return are_of_several(held) || (held.windows.size() < kFewWindows && are_of_several(data));
}

Eigen::VectorXd unseenBeyondDifferences(const SimulationData& data, const WindowFit& fit,
                                        const SimulationData& held) {
  const Eigen::VectorXd of_held = errorsBeyondDifferences(held, fit.model);
  if (of_held.size() == 0) return {};
  Eigen::VectorXd all(static_cast<Eigen::Index>(data.windows.size()) + of_held.size());
  all << leftOutBeyondDifferences(data, fit), of_held;
  return all;
}

}  // namespace uncertainty_identification
