#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace uncertainty_identification {

/// The smallest value such that a given share of all values is not above it; NaN if there are none.
inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::nan("");
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

}  // namespace uncertainty_identification
