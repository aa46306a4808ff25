#include "curves/held_out.h"

#include <algorithm>
#include <cmath>

#include "curves/free_simulation.h"
#include "curves/initial_states.h"
#include "curves/window_products.h"

namespace uncertainty_identification {
namespace {

constexpr double kLargest = 1e6;  ///< error of a simulation that diverges

/// How often a signal changes its value.
int changesOf(const Eigen::VectorXd& signal) {
  int count = 0;
  for (Eigen::Index k = 1; k < signal.size(); ++k) count += signal[k] != signal[k - 1];
  return count;
}

}  // namespace

int seenSamples(const SimulationData& held, const CurveModel& model) {
  return std::max({8 * model.order, held.longest / 10, 20});
}

std::vector<Eigen::VectorXd> heldOutSimulations(const SimulationData& held,
                                                const CurveModel& model) {
  const std::vector<CurveTable> tables = tablesOf(model);
  const std::vector<Eigen::VectorXd> initial = initialStates(held, model, seenSamples(held, model));
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
        window.measured * squares.isFinite().select(squares.min(kLargest), kLargest);
    const int samples = window.samples() - window.rest;
    for (int part = 0; part < parts; ++part) {
      const int begin = part * samples / parts, end = (part + 1) * samples / parts;
      errors.push_back(weighted.segment(window.rest + begin, end - begin).sum());
    }
  }
  return Eigen::Map<Eigen::VectorXd>(errors.data(), static_cast<Eigen::Index>(errors.size()));
}

Eigen::VectorXd unseenErrors(const WindowFit& fit, const SimulationData& held) {
  const Eigen::VectorXd of_held = heldOutErrors(held, fit.model);
  Eigen::VectorXd all(fit.left_out_of.size() + of_held.size());
  all << fit.left_out_of, of_held;
  return all;
}

Eigen::VectorXd errorsBeyondGain(const SimulationData& held, const CurveModel& model) {
  if (std::all_of(held.windows.begin(), held.windows.end(),
                  [](const SimulationWindow& window) { return changesOf(window.u) <= 1; }))
    return {};
  const std::vector<CurveTable> tables = tablesOf(model);
  const std::vector<Eigen::VectorXd> initial = initialStates(held, model, held.longest);
  const Eigen::MatrixXd own = gainAndOffset(model);
  const Eigen::VectorXd as_it_is = Eigen::VectorXd::Zero(model.parameters());
  Eigen::VectorXd errors(static_cast<Eigen::Index>(held.windows.size()));
  for (const std::vector<int>& windows : windowsByRecord(held)) {
    std::vector<WindowProducts::Block> blocks;
    blocks.reserve(windows.size());
    for (const int w : windows) {
      const auto k = static_cast<std::size_t>(w);
      blocks.push_back(productsOf(model, tables, held.windows[k], initial[k], 1).total());
    }
    const Eigen::VectorXd beyond = errorsBeyond(blocks, as_it_is, own);
    for (std::size_t k = 0; k < windows.size(); ++k) {
      const double error = beyond[static_cast<Eigen::Index>(k)];
      errors[windows[k]] = std::isfinite(error) ? error : kLargest;
    }
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

Eigen::VectorXd unseenBeyondGain(const WindowFit& fit, const SimulationData& held) {
  const Eigen::VectorXd of_held = errorsBeyondGain(held, fit.model);
  if (of_held.size() == 0) return {};
  Eigen::VectorXd all(fit.left_out_beyond_gain.size() + of_held.size());
  all << fit.left_out_beyond_gain, of_held;
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
