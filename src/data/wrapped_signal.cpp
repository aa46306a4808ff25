#include "data/wrapped_signal.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace uncertainty_identification {
namespace {

/// Middle step of those from sample `first` to `last` that are no jumps; 0 if there are none.
double motionBetween(const std::vector<double>& y, int first, int last, double jump) {
  std::vector<double> steps;
  for (int t = std::max(first, 0) + 1; t <= std::min(last, static_cast<int>(y.size()) - 1); ++t) {
    const double step = y[static_cast<std::size_t>(t)] - y[static_cast<std::size_t>(t) - 1];
    if (std::abs(step) < jump) steps.push_back(step);
  }
  if (steps.empty()) return 0;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

}  // namespace

int wrapsOf(const Experiment& experiment) {
  constexpr int kFewest = 3, kNear = 5;                          // jumps; samples
  constexpr double kJump = 0.6, kSmooth = 0.3, kMotion = 0.002;  // of the range
  constexpr double kNearlyAll = 0.8;
  std::vector<double> y;
  for (int t = 0; t < experiment.samples(); ++t)
    if (experiment.isValid(t)) y.push_back(experiment.y[t]);
  if (y.size() < 2) return 0;
  const auto [low, high] = std::minmax_element(y.begin(), y.end());
  const double range = *high - *low;
  int jumps = 0, wraps = 0, smooth = 0;
  for (int t = 1; t < static_cast<int>(y.size()); ++t) {
    const double step = y[static_cast<std::size_t>(t)] - y[static_cast<std::size_t>(t) - 1];
    smooth += std::abs(step) < kSmooth * range;
    if (!(std::abs(step) > kJump * range)) continue;
    ++jumps;
    const double before = motionBetween(y, t - 1 - kNear, t - 1, kJump * range),
                 after = motionBetween(y, t, t + kNear, kJump * range);
    const double least = kMotion * range * std::abs(step);
    wraps += -before * step > least && -after * step > least;
  }
  const bool is_smooth = smooth + jumps >= 0.95 * static_cast<double>(y.size() - 1);
  return wraps >= kFewest && wraps >= kNearlyAll * jumps && is_smooth ? wraps : 0;
}

}  // namespace uncertainty_identification
