#include "curves/plant_orders.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "curves/fit_comparison.h"
#include "curves/held_out.h"
#include "curves/starts.h"

namespace uncertainty_identification {
namespace {

constexpr double kFall = 0.7;  ///< of an error, which is much

/// Number of states and direct terms, by which models are ordered.
double sizeOf(const WindowFit& fit) { return fit.model.order + (fit.model.direct ? 0.5 : 0.0); }

CurveModel withDirectTerm(const CurveModel& model) {
  CurveModel larger = model;
  larger.direct = true;
  const Eigen::Index before = 2 * model.order, after = model.theta.size() - before;
  larger.theta.resize(model.theta.size() + 1);
  larger.theta << model.theta.head(before), 0.0, model.theta.tail(after);
  return larger;
}

WindowFit withDelay(const SimulationData& data, const WindowFit& fit, int delay,
                    const CurveSearchContext& context) {
  CurveModel later = fit.model;
  later.delay = delay;
  WindowFit best = fitFreely(data, later, context.limits(10));
  if (!fit.model.curves.empty()) return best;
  WindowFit anew = fitFreely(data, linearStart(data, fit.model.order, fit.model.direct, delay),
                             context.limits(10));
  return anew.left_out < best.left_out ? anew : best;
}

/// The model with the dead time that a scan finds, if it lowers what is left out by a quarter.
WindowFit withScannedDelay(const SimulationData& data, WindowFit fit,
                           const CurveSearchContext& context) {
  CurveModel best;
  double least = 0.9 * fit.squared_error;
  for (const int delay : {1, 2, 3, 4, 6, 8, 12, 16, 24}) {
    const CurveModel start = linearStart(data, fit.model.order, false, delay, 3);
    const double error = simulationError(data, start);
    if (error < 0.95 * least) {
      least = error;
      best = start;
    } else if (delay >= 3) {
      break;
    }
  }
  if (best.delay == 0) return fit;
  WindowFit later = fitFreely(data, std::move(best), context.limits(15));
  return later.left_out < 0.75 * fit.left_out ? later : fit;
}

/// Plants of orders up to 8, each from the one with a mode less: as many as lower the error by
/// much. Fitted all at once from least squares, the modes of a flexible structure end in local
/// optima.
std::vector<WindowFit> fitModes(const SimulationData& data, std::vector<WindowFit> fits,
                                const CurveSearchContext& context) {
  constexpr std::size_t kHighest = 8;
  const auto gains = [&] {  // the last mode, to an even number of orders
    const std::size_t modes = fits.size() / 2;
    return fits[2 * modes - 1].squared_error < kFall * fits[2 * modes - 3].squared_error;
  };
  while (context.going_on() && (fits.size() < 4 || (fits.size() < kHighest && gains()))) {
    WindowFit next =
        fitFreely(data, withMode(data, fits[fits.size() - 2].model), context.limits(15));
    WindowFit other =
        fitFreely(data, withCancellingPair(fits.back().model, 0.5), context.limits(15));
    fits.push_back(other.squared_error < next.squared_error ? std::move(other) : std::move(next));
  }
  return fits;
}

}  // namespace

LinearPlants fitLinearPlants(const SimulationData& data, int max_order,
                             const CurveSearchContext& context) {
  std::vector<WindowFit> fits(static_cast<std::size_t>(2 * max_order));
  const auto at = [&](int order, bool direct) -> WindowFit& {
    return fits[static_cast<std::size_t>(2 * (order - 1) + (direct ? 1 : 0))];
  };
  context.pool->forEach(2, [&](int direct) {
    for (int order = 1; order <= max_order; ++order) {
      WindowFit& best = at(order, direct != 0);
      best = fitFreely(data, linearStart(data, order, direct != 0, 0), context.limits(15));
      if (order > 1) {
        WindowFit other = fitFreely(data, withCancellingPair(at(order - 1, direct != 0).model, 0.5),
                                    context.limits(15));
        if (other.squared_error < best.squared_error) best = std::move(other);
      }
      if (direct == 0) best = withScannedDelay(data, std::move(best), context);
    }
  });
  const WindowFit* chosen = &fits.front();
  for (const WindowFit& fit : fits) {
    const double orders = std::max(1.0, std::floor(sizeOf(fit)) - chosen->model.order);
    if (fit.left_out < chosen->left_out * std::pow(kFall, 2 * orders) &&
        pairedT(chosen->left_out_of, fit.left_out_of) > 1)
      chosen = &fit;
  }
  LinearPlants found;
  found.starts.push_back(*chosen);
  if (chosen->model.order < max_order) found.starts.push_back(at(chosen->model.order + 1, false));
  for (int order = 1; order <= max_order; ++order) {
    const WindowFit &plain = at(order, false), &direct = at(order, true);
    found.of_order.push_back(direct.left_out < 0.9 * plain.left_out ? direct : plain);
    found.delayed.push_back(plain);
  }
  return found;
}

std::optional<WindowFit> modalPlant(const SimulationData& data, const SimulationData& held,
                                    const LinearPlants& linear, const CurveSearchContext& context) {
  constexpr double kHalf = 0.5;
  constexpr int kSamplesOfState = 24;  // of a window, for each order
  const WindowFit& start = linear.starts.front();
  std::optional<WindowFit> best;
  double left_out = start.left_out, held_out = heldOutErrors(held, start.model).sum();
  for (const WindowFit& each : fitModes(data, {linear.delayed[0], linear.delayed[1]}, context)) {
    // The initial states of short windows take up what high orders leave.
    if (each.model.order * kSamplesOfState > held.longest) break;
    const double error = heldOutErrors(held, each.model).sum();
    if (!(each.left_out < kHalf * left_out && error < kHalf * held_out)) continue;
    left_out = each.left_out;
    held_out = error;
    best = each;
  }
  return best;
}

std::vector<PlantChange> largerPlants(const SimulationData& data, const WindowFit& fit,
                                      const LinearPlants& linear, int max_order,
                                      const CurveSearchContext& context) {
  std::vector<PlantChange> changes;
  if (fit.model.order < max_order)
    for (int k = 0; k < 2; ++k) changes.push_back({PlantChange::Kind::order, {}});
  const bool is_loop = fit.model.has(Place::loop_error);  // which has no direct term
  if (!fit.model.direct && !is_loop) changes.push_back({PlantChange::Kind::direct, {}});
  const std::size_t delays = changes.size();
  // Without a higher order to compete with, dead time would stand for any lag.
  for (int k = 0; k < (fit.model.order < max_order ? 4 : 0); ++k)
    changes.push_back({PlantChange::Kind::delay, {}});
  context.pool->forEach(static_cast<int>(changes.size()), [&](int index) {
    const auto k = static_cast<std::size_t>(index);
    PlantChange& change = changes[k];
    if (change.kind == PlantChange::Kind::order)
      change.fit =
          fitFreely(data, withCancellingPair(fit.model, k == 0 ? 0.5 : 0.9), context.limits(12));
    else if (change.kind == PlantChange::Kind::direct)
      change.fit = fitFreely(data, withDirectTerm(fit.model), context.limits(10));
    else
      change.fit =
          withDelay(data, fit, fit.model.delay + std::vector<int>{1, 2, 3, 5}[k - delays], context);
  });
  for (const WindowFit& other : linear.of_order) {
    const int more = other.model.order - fit.model.order;
    if (fit.model.curves.empty() && more > 0 && more <= 2)
      changes.push_back({PlantChange::Kind::order, other});
  }
  return changes;
}

WindowFit smallerPlant(const SimulationData& data, WindowFit fit,
                       const CurveSearchContext& context) {
  while (fit.model.order > 1 && context.going_on()) {
    CurveModel smaller = linearStart(data, fit.model.order - 1, fit.model.direct, fit.model.delay);
    const Eigen::Index curves = fit.model.theta.size() - fit.model.linearParameters();
    Eigen::VectorXd theta(smaller.theta.size() + curves);
    theta << smaller.theta, fit.model.theta.tail(curves);
    smaller.theta = std::move(theta);
    smaller.curves = fit.model.curves;
    smaller.rate_scale = fit.model.rate_scale;
    smaller.input_zero = fit.model.input_zero;
    smaller.initial.clear();
    WindowFit refitted = fitFreely(data, std::move(smaller), context.limits(15));
    if (!(refitted.left_out < 1.03 * fit.left_out)) break;
    fit = std::move(refitted);
  }
  return fit;
}

}  // namespace uncertainty_identification
