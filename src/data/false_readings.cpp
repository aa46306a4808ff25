#include "data/false_readings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "data/text.h"

namespace uncertainty_identification {
namespace {

std::string told(const std::string& role, const StampedSignal& signal, std::size_t place) {
  return role + " " + text(signal.values[place]) + " at " + text(signal.stamps[place]) + " s";
}

}  // namespace

std::vector<std::size_t> falseReadings(const std::vector<double>& values, double far) {
  constexpr std::size_t kFewest = 20, kOneIn = 200;
  std::vector<std::size_t> finite;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isfinite(values[i])) finite.push_back(i);
  if (finite.size() < kFewest) return {};
  std::vector<double> sorted;
  for (const std::size_t i : finite) sorted.push_back(values[i]);
  std::sort(sorted.begin(), sorted.end());
  const std::size_t most = std::max<std::size_t>(1, sorted.size() / kOneIn);
  const double lowest = sorted[most], highest = sorted[sorted.size() - 1 - most];
  const double reach = far * (highest - lowest);
  if (!(reach > 0)) return {};
  std::vector<std::size_t> places;
  bool follows = false;
  for (std::size_t k = 0; k < finite.size(); ++k) {
    const double value = values[finite[k]];
    const bool is_false = value < lowest - reach || value > highest + reach;
    const bool is_end = k == 0 || k + 1 == finite.size();
    if (is_false && (follows || is_end || places.size() == most)) return {};
    if (is_false) places.push_back(finite[k]);
    follows = is_false;
  }
  return places;
}

std::string replaceFalseReadings(StampedSignal* input, StampedSignal* output) {
  constexpr double kFarOfInput = 1e5, kFarOfOutput = 1e3;
  const std::vector<std::size_t> inputs = falseReadings(input->values, kFarOfInput),
                                 outputs = falseReadings(output->values, kFarOfOutput);
  const std::size_t count = inputs.size() + outputs.size();
  if (count == 0) return "";
  std::string examples;
  if (!inputs.empty()) examples = told("input", *input, inputs.front());
  if (!outputs.empty())
    examples += (examples.empty() ? "" : ", ") + told("output", *output, outputs.front());
  for (const std::size_t place : inputs) input->values[place] = input->values[place - 1];
  for (const std::size_t place : outputs)
    output->values[place] = std::numeric_limits<double>::quiet_NaN();
  return std::to_string(count) + (count == 1 ? " single reading lies" : " single readings lie") +
         " far beyond the range of all others (" + examples + ") and " +
         (count == 1 ? "is" : "are") +
         " taken for false: an input keeps the value before, an output counts as missing";
}

}  // namespace uncertainty_identification
