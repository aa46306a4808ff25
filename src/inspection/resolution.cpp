#include "inspection/resolution.h"

#include <algorithm>
#include <cmath>

namespace uncertainty_identification {
namespace {

constexpr double kSingle = 3e-7;      // relative rounding of single precision, with some reserve
constexpr double kNearWhole = 0.1;    // [steps] a multiple may differ from a whole number
constexpr double kAgreeing = 0.95;    // share of the differences that must be multiples
constexpr double kTypicalSteps = 30;  // [steps] median difference above which a match says little
constexpr double kDense = 3;          // [roundings] median difference of values without gaps
constexpr std::size_t kCompared = 5000;  // differences

/// Share of the differences that are whole multiples, and the step that fits them best.
struct StepMatch {
  double share = 0, step = 0;
};

StepMatch matchOf(const std::vector<double>& differences, double step) {
  double agreeing = 0, length = 0, steps = 0;
  for (const double difference : differences) {
    const double multiple = std::round(difference / step);
    if (std::abs(difference / step - multiple) > kNearWhole) continue;
    ++agreeing;
    length += difference;
    steps += multiple;
  }
  return {agreeing / static_cast<double>(differences.size()), steps > 0 ? length / steps : 0};
}

/// Whether levels lie hardly farther apart than the rounding that was merged. Then the values
/// differ by less than that all along: a counter of millions, or noise on a large offset.
bool areDense(const std::vector<double>& levels, double rounding) {
  if (levels.size() < 3) return false;
  std::vector<double> differences;
  differences.reserve(levels.size());
  for (std::size_t i = 1; i < levels.size(); ++i) differences.push_back(levels[i] - levels[i - 1]);
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  return *middle < kDense * rounding;
}

}  // namespace

std::vector<double> levelsOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  if (values.empty()) return values;
  const double rounding = kSingle * std::max(std::abs(values.front()), std::abs(values.back()));
  std::vector<double> levels;
  for (const double value : values)
    if (levels.empty() || value - levels.back() > rounding) levels.push_back(value);
  const bool merged = levels.size() < values.size();
  return merged && areDense(levels, rounding) ? values : levels;
}

double resolutionOf(const std::vector<double>& levels) {
  if (levels.size() < 3) return 0;
  std::vector<double> differences;
  for (std::size_t i = 1; i < levels.size(); ++i) differences.push_back(levels[i] - levels[i - 1]);
  std::sort(differences.begin(), differences.end());
  if (differences.size() > kCompared) differences.resize(kCompared);
  const double smallest = differences.front();
  if (differences[differences.size() / 2] > kTypicalSteps * smallest) return 0;
  const StepMatch first = matchOf(differences, smallest);
  const StepMatch second = matchOf(differences, first.step);  // the smallest one is rounded most
  return second.share >= kAgreeing ? second.step : 0;
}

}  // namespace uncertainty_identification
