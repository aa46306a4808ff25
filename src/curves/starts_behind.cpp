#include "curves/starts_behind.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "curves/free_simulation.h"
#include "curves/starts.h"
#include "curves/window_fit.h"

namespace uncertainty_identification {
namespace {

/// The data with the input behind a play or a limit of its rate.
SimulationData through(SimulationData data, Place place, double width) {
  for (SimulationWindow& window : data.windows) {
    double held = window.u[0];
    for (Eigen::Index k = 0; k < window.u.size(); ++k) {
      double& value = window.u[k];
      if (place == Place::play)
        held = std::min(std::max(held, value - width), value + width);
      else
        held += std::min(std::max(value - held, -width), width);
      value = held;
    }
  }
  return data;
}

}  // namespace

std::vector<double> widthsFor(const SimulationData& data, Place place) {
  if (place == Place::input_hysteresis) return {0};  // the simulation is linear in its weights
  if (place != Place::rate_limit) return {0.1, 0.25, 0.5};
  std::vector<double> changes;
  for (const SimulationWindow& window : data.windows)
    for (Eigen::Index k = 1; k < window.u.size(); ++k)
      if (const double change = std::abs(window.u[k] - window.u[k - 1]); change > 1e-9)
        changes.push_back(change);
  if (changes.empty()) return {};
  std::sort(changes.begin(), changes.end());
  const auto quantile = [&](double share) {
    return changes[static_cast<std::size_t>(share * static_cast<double>(changes.size() - 1))];
  };
  constexpr int kWidths = 8;
  const double least = 0.3 * quantile(0.5), ratio = 0.9 * quantile(0.995) / least;
  std::vector<double> widths;
  widths.reserve(kWidths);
  for (int k = 0; k < kWidths; ++k) widths.push_back(least * std::pow(ratio, k / (kWidths - 1.0)));
  return widths;
}

CurveModel startBehind(const SimulationData& data, const CurveModel& linear, Place place) {
  constexpr int kIterations = 3;
  CurveModel best;
  best.order = 0;
  double least = std::numeric_limits<double>::infinity(), width_of_best = 0;
  for (const double width : widthsFor(data, place)) {
    const SimulationData behind = through(data, place, width);
    CurveModel start = linearStart(behind, linear.order, linear.direct, linear.delay, kIterations);
    const double error = simulationError(behind, start);
    if (!(error < least)) continue;
    least = error;
    width_of_best = width;
    best = std::move(start);
  }
  if (best.order == 0) return best;
  best.theta.conservativeResize(best.theta.size() + 1);
  best.theta.tail(1).setConstant(width_of_best);
  best.curves.push_back(Curve(place));
  return best;
}

PlantBesideCovariate plantBeside(const SimulationData& data, const CurveModel& linear,
                                 const std::string& covariate) {
  constexpr int kIterations = 2;
  const double ratio = ratioOfGains(data, linear, covariate);
  SimulationData together = data;
  for (SimulationWindow& window : together.windows)
    window.u += ratio * window.covariates.at(covariate);
  CurveModel plant = linearStart(together, linear.order, linear.direct, linear.delay, kIterations);
  if (plant.theta.size() == 0) plant.order = 0;
  return {std::move(plant), ratio};
}

}  // namespace uncertainty_identification
