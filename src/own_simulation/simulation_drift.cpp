#include "own_simulation/simulation_drift.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "data/text.h"
#include "math/distributions.h"

namespace uncertainty_identification {
namespace {

constexpr std::size_t kFirst = 10, kNewest = 5;
constexpr int kFewest = 6;              // experiments that are compared
constexpr double kFalseAlarms = 0.001;  // of the decisions
constexpr int kNumbers = 4;

/// Mean and sum of squared deviations.
struct Moments {
  double mean = 0, squares = 0, squared_errors = 0;
};

template <class Entry>
Moments momentsOf(const Entry* begin, std::size_t count) {
  Moments moments;
  for (std::size_t i = 0; i < count; ++i) {
    moments.mean += begin[i].value / static_cast<double>(count);
    moments.squared_errors += begin[i].squared_error;
  }
  for (std::size_t i = 0; i < count; ++i)
    moments.squares += std::pow(begin[i].value - moments.mean, 2);
  return moments;
}

bool differ(const Moments& before, double before_count, const Moments& now, double now_count) {
  const double degrees = before_count + now_count - 2;
  const double spread = (before.squares + now.squares) / degrees;
  const double errors = (before.squared_errors + now.squared_errors) / (before_count + now_count);
  const double deviation = std::sqrt(std::max(spread, errors) * (1 / before_count + 1 / now_count));
  const double limit = studentQuantile(1 - kFalseAlarms / kNumbers / 2, degrees);
  return std::abs(now.mean - before.mean) > limit * deviation;
}

}  // namespace

void SimulationDrift::append(const ErrorNumber& number, History* history) {
  if (!std::isfinite(number.value) || !std::isfinite(number.standard_error)) return;
  const Entry entry{number.value, number.standard_error * number.standard_error};
  ++history->count;
  if (history->first.size() < kFirst) history->first.push_back(entry);
  if (history->newest.size() == kNewest) history->newest.erase(history->newest.begin());
  history->newest.push_back(entry);
}

void SimulationDrift::add(const SimulationErrors& errors) {
  ++experiments_;
  append(errors.fit, &histories_[0]);
  append(errors.bias, &histories_[1]);
  append(errors.gain, &histories_[2]);
  append(errors.delay, &histories_[3]);
}

/// How a number differs, in words; empty where it does not.
std::string SimulationDrift::differenceOf(const History& history, const char* name,
                                          const char* unit) {
  if (history.count < kFewest) return "";
  const auto count = static_cast<std::size_t>(history.count);
  const std::size_t now_count = std::min(kNewest, count / 3);
  const std::size_t before_count = std::min(kFirst, count - now_count);
  const Moments before = momentsOf(history.first.data(), before_count);
  const Moments now =
      momentsOf(history.newest.data() + history.newest.size() - now_count, now_count);
  if (!differ(before, static_cast<double>(before_count), now, static_cast<double>(now_count)))
    return "";
  return std::string(name) + " " + rounded(before.mean) + unit + " in the first " +
         std::to_string(before_count) + " experiments, " + rounded(now.mean) + unit +
         " in the last " + std::to_string(now_count);
}

DriftDecision SimulationDrift::decision() const {
  constexpr std::array<const char*, kNumbers> kNames{"fit", "bias", "gain", "delay error"};
  constexpr std::array<const char*, kNumbers> kUnits{" %", "", "", " s"};
  if (experiments_ < kFewest)
    return {false, "Whether the simulation drifts is told from " + std::to_string(kFewest) +
                       " experiments on; there are " + std::to_string(experiments_) + "."};
  std::string all;
  for (std::size_t i = 0; i < kNumbers; ++i) {
    const std::string difference = differenceOf(histories_[i], kNames[i], kUnits[i]);
    if (!difference.empty()) all += (all.empty() ? "" : "; ") + difference;
  }
  if (all.empty()) return {false, "The simulation is as far from the machine as at first."};
  return {true, "The simulation has drifted away from the machine: " + all +
                    ". Look for what has changed in the machine, or correct the simulation and "
                    "call ~reset."};
}

}  // namespace uncertainty_identification
