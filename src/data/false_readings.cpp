#include "data/false_readings.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "data/text.h"

namespace uncertainty_identification {
namespace {

std::string told(const std::string& role, const std::vector<double>& stamps,
                 const std::vector<double>& values, std::size_t place) {
  return role + " " + text(values[place]) + " at " + text(stamps[place]) + " s";
}

/// The value that `place` others are below.
double ranked(std::vector<double>* values, std::size_t place) {
  const auto at = values->begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(values->begin(), at, values->end());
  return *at;
}

}  // namespace

std::vector<std::size_t> falseReadings(const std::vector<double>& values, double far) {
  constexpr std::size_t kFewest = 20, kOneIn = 200;
  std::vector<double> finite;
  finite.reserve(values.size());
  std::copy_if(values.begin(), values.end(), std::back_inserter(finite),
               [](double value) { return std::isfinite(value); });
  const std::size_t count = finite.size();
  if (count < kFewest) return {};
  const double first = finite.front(), last = finite.back();
  const std::size_t most = std::max<std::size_t>(1, count / kOneIn);
  const double lowest = ranked(&finite, most), highest = ranked(&finite, count - 1 - most);
  const double reach = far * (highest - lowest);
  const auto is_false = [&](double value) {
    return value < lowest - reach || value > highest + reach;
  };
  if (!(reach > 0) || is_false(first) || is_false(last)) return {};
  std::vector<std::size_t> places;
  bool follows = false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    const bool found = is_false(values[i]);
    if (found && (follows || places.size() == most)) return {};
    if (found) places.push_back(i);
    follows = found;
  }
  return places;
}

std::string replaceFalseReadings(const std::vector<double>& input_stamps,
                                 std::vector<double>* input,
                                 const std::vector<double>& output_stamps,
                                 std::vector<double>* output) {
  constexpr double kFarOfInput = 1e5, kFarOfOutput = 1e3;
  const std::vector<std::size_t> inputs = falseReadings(*input, kFarOfInput),
                                 outputs = falseReadings(*output, kFarOfOutput);
  const std::size_t count = inputs.size() + outputs.size();
  if (count == 0) return "";
  std::string examples;
  if (!inputs.empty()) examples = told("input", input_stamps, *input, inputs.front());
  if (!outputs.empty())
    examples +=
        (examples.empty() ? "" : ", ") + told("output", output_stamps, *output, outputs.front());
  for (const std::size_t place : inputs) (*input)[place] = (*input)[place - 1];
  for (const std::size_t place : outputs)
    (*output)[place] = std::numeric_limits<double>::quiet_NaN();
  return std::to_string(count) + (count == 1 ? " single reading lies" : " single readings lie") +
         " far beyond the range of all others (" + examples + ") and " +
         (count == 1 ? "is" : "are") +
         " taken for false: an input keeps the value before, an output counts as missing";
}

}  // namespace uncertainty_identification
