#include "curves/simulation_data.h"

#include <algorithm>
#include <cmath>

namespace uncertainty_identification {

Scale scaleOf(double sum, double squares, double count, bool remove_mean) {
  const double mean = sum / std::max(count, 1.0);
  const double deviation =
      std::sqrt(std::max(squares / std::max(count, 1.0) - mean * mean, 0.0)) + 1e-12;
  return {remove_mean || std::abs(mean) > 3 * deviation ? mean : 0.0, deviation};
}

}  // namespace uncertainty_identification
