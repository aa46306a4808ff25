#include "data/false_readings.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "data/text.h"

namespace uncertainty_identification {

std::vector<std::size_t> falseReadings(const std::vector<double>& values) {
  constexpr double kFar = 1000;        // ranges of the others
  constexpr std::size_t kFewest = 20;  // values that show a range
  std::vector<double> sorted;
  for (const double value : values)
    if (std::isfinite(value)) sorted.push_back(value);
  if (sorted.size() < kFewest) return {};
  std::sort(sorted.begin(), sorted.end());
  const std::size_t most = std::max<std::size_t>(1, sorted.size() / 200);
  const double lowest = sorted[most], highest = sorted[sorted.size() - 1 - most];
  const double reach = kFar * (highest - lowest);
  if (!(reach > 0)) return {};
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(values[i] < lowest - reach || values[i] > highest + reach)) continue;
    const bool follows = !places.empty() && places.back() + 1 == i;
    if (follows || places.size() == most) return {};
    places.push_back(i);
  }
  return places;
}

ReplacedReadings replaceFalseReadings(const std::vector<double>& stamps, bool is_held,
                                      std::vector<double>* values) {
  ReplacedReadings replaced;
  for (const std::size_t place : falseReadings(*values)) {
    double& value = (*values)[place];
    if (replaced.count++ == 0)
      replaced.first = rounded(value) + " at " + text(stamps[place]) + " s";
    value =
        is_held ? (*values)[place > 0 ? place - 1 : 1] : std::numeric_limits<double>::quiet_NaN();
  }
  return replaced;
}

std::string sentenceOf(const ReplacedReadings& input, const ReplacedReadings& output) {
  const int count = input.count + output.count;
  if (count == 0) return "";
  return std::to_string(count) + (count == 1 ? " single reading is" : " single readings are") +
         " more than a thousand times as far off as all others spread (the " +
         (input.count > 0 ? "input is " + input.first : "output is " + output.first) +
         ") and taken for false: the input is held over it, an output is missing";
}

}  // namespace uncertainty_identification
