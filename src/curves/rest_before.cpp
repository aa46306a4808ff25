#include "curves/rest_before.h"

#include <algorithm>
#include <cmath>

namespace uncertainty_identification {
namespace {

struct Range {
  double low = 0, high = 0;
  bool any = false;

  void add(double value) {
    low = any ? std::min(low, value) : value;
    high = any ? std::max(high, value) : value;
    any = true;
  }
  double width() const { return high - low; }
};

bool isConstant(const Eigen::VectorXd& signal) { return (signal.array() == signal[0]).all(); }

/// The largest difference of an input that does not move: a measured one is noisy.
double stillnessOf(const Eigen::VectorXd& u) { return 0.02 * (u.maxCoeff() - u.minCoeff()); }

/// Whether the record is one of few steps. Where the input moves often, it and not an initial state
/// explains the output.
bool hasFewSteps(const Eigen::VectorXd& u) {
  constexpr int kFew = 5;
  const double still = stillnessOf(u);
  int steps = 0;
  for (Eigen::Index k = 1; k < u.size(); ++k) steps += std::abs(u[k] - u[k - 1]) > still;
  return steps <= kFew;
}

/// Number of samples before the input moves for the first time.
int samplesBeforeInputMoves(const Experiment& experiment) {
  const Eigen::VectorXd& u = experiment.u;
  const double still = stillnessOf(u);
  int count = 1;
  while (count < experiment.samples() && std::abs(u[count] - u[0]) <= still) ++count;
  return count;
}

/// Whether the output stands still in the first `count` samples: its readings are the same, or the
/// two halves of these differ by little against what so many samples make of it later.
bool standsStill(const Experiment& experiment, int count) {
  constexpr int kFewest = 3, kFewestNoisy = 8;
  constexpr double kLittle = 0.1;
  const Eigen::VectorXd& y = experiment.y;
  for (int t = 0; t < count; ++t)
    if (!experiment.isValid(t)) return false;
  if (count < kFewest || count >= experiment.samples()) return false;
  if ((y.head(count).array() == y[0]).all()) return true;
  if (count < kFewestNoisy) return false;
  const int half = count / 2;
  const auto change = [&](int begin) {
    return y.segment(begin + half, half).mean() - y.segment(begin, half).mean();
  };
  double squares = 0;
  int changes = 0;
  for (int begin = count; begin + 2 * half <= experiment.samples(); begin += half, ++changes)
    squares += change(begin) * change(begin);
  return changes > 0 && std::abs(change(0)) < kLittle * std::sqrt(squares / changes);
}

}  // namespace

RestBefore::RestBefore(const std::vector<Experiment>& experiments) {
  constexpr std::size_t kFewest = 3;
  constexpr double kSameLevel = 0.05, kOtherInputs = 0.5;  // of the ranges of output and input
  Range inputs, outputs, first_inputs, levels;
  bool all_constant = true;
  for (const Experiment& experiment : experiments) {
    for (int t = 0; t < experiment.samples(); ++t) {
      inputs.add(experiment.u[t]);
      if (experiment.isValid(t)) outputs.add(experiment.y[t]);
    }
    if (!experiment.isValid(0)) return;
    all_constant = all_constant && isConstant(experiment.u);
    first_inputs.add(experiment.u[0]);
    levels.add(experiment.y[0]);
  }
  tolerance_ = kSameLevel * outputs.width();
  const double level = 0.5 * (levels.low + levels.high);
  const bool near_zero = inputs.low <= inputs.width() && -inputs.high <= inputs.width();
  if (experiments.size() >= kFewest && levels.width() <= tolerance_ &&
      first_inputs.width() >= kOtherInputs * inputs.width() &&
      ((all_constant && near_zero) || std::abs(level) <= tolerance_))
    level_ = level;
}

std::optional<RestingPoint> RestBefore::of(const Experiment& experiment) const {
  if (!hasFewSteps(experiment.u)) return std::nullopt;
  const bool is_constant = isConstant(experiment.u);
  const int count = samplesBeforeInputMoves(experiment);
  if (standsStill(experiment, count))
    return RestingPoint{experiment.u[0], experiment.y.head(count).mean()};
  if (level_ && is_constant && experiment.isValid(0) &&
      std::abs(experiment.y[0] - *level_) <= tolerance_)
    return RestingPoint{0, experiment.y[0]};
  return std::nullopt;
}

}  // namespace uncertainty_identification
