#include "curves/held_out.h"

#include <algorithm>
#include <cmath>

#include "curves/free_simulation.h"
#include "curves/initial_states.h"

namespace uncertainty_identification {
namespace {

constexpr double kLargestError = 1e6;  ///< error of a simulation that diverges

}  // namespace

int seenSamples(const SimulationData& held, const CurveModel& model) {
  return std::max({8 * model.order, held.longest / 10, 20});
}

std::vector<Eigen::VectorXd> heldOutSimulations(const SimulationData& held,
                                                const CurveModel& model) {
  const std::vector<CurveTable> tables = tablesOf(model);
  // Its first samples do not show a window's level.
  const int seen = model.own_level ? held.longest : seenSamples(held, model);
  const std::vector<Eigen::VectorXd> initial = initialStates(held, model, seen);
  std::vector<Eigen::VectorXd> outputs;
  for (std::size_t w = 0; w < held.windows.size(); ++w)
    outputs.push_back(simulateFreely(model, tables, held.windows[w], initial[w], false).y);
  return outputs;
}

Eigen::VectorXd heldOutErrors(const SimulationData& held, const CurveModel& model) {
  constexpr int kManyWindows = 8, kShortestPart = 50;
  const std::vector<Eigen::VectorXd> outputs = heldOutSimulations(held, model);
  const int parts = static_cast<int>(outputs.size()) >= kManyWindows
                        ? 1
                        : std::max(1, std::min(4, held.longest / kShortestPart));
  std::vector<double> errors;
  for (std::size_t w = 0; w < outputs.size(); ++w) {
    const SimulationWindow& window = held.windows[w];
    const Eigen::ArrayXd squares = (window.y - outputs[w]).array().square();
    const Eigen::ArrayXd weighted =
        window.measured * squares.isFinite().select(squares.min(kLargestError), kLargestError);
    const int samples = window.samples() - window.rest;
    for (int part = 0; part < parts; ++part) {
      const int begin = part * samples / parts, end = (part + 1) * samples / parts;
      errors.push_back(weighted.segment(window.rest + begin, end - begin).sum());
    }
  }
  return Eigen::Map<Eigen::VectorXd>(errors.data(), static_cast<Eigen::Index>(errors.size()));
}

double errorFromBestStates(const SimulationData& held, const CurveModel& model) {
  CurveModel from = model;
  from.initial = initialStates(held, model, held.longest);
  return simulationError(held, from);
}

Eigen::VectorXd unseenErrors(const WindowFit& fit, const SimulationData& held) {
  const Eigen::VectorXd of_held = heldOutErrors(held, fit.model);
  Eigen::VectorXd all(fit.left_out_of.size() + of_held.size());
  all << fit.left_out_of, of_held;
  return all;
}

double heldOutFit(const SimulationData& held, const Eigen::VectorXd& errors) {
  double count = 0, sum = 0, squares = 0;
  for (const SimulationWindow& window : held.windows) {
    const int samples = window.samples() - window.rest;
    const Eigen::ArrayXd measured = window.measured.tail(samples), y = window.y.tail(samples);
    count += measured.sum();
    sum += (measured * y).sum();
    squares += (measured * y.square()).sum();
  }
  const double spread = squares - sum * sum / std::max(count, 1.0);
  return 100 * (1 - std::sqrt(errors.sum() / std::max(spread, 1e-300)));
}

}  // namespace uncertainty_identification
