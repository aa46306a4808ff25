#include "own_simulation/output_filters.h"

#include <algorithm>
#include <cmath>

namespace uncertainty_identification {

Eigen::VectorXd delayedOutput(const Eigen::VectorXd& y, double samples) {
  const Eigen::Index last = y.size() - 1;
  const double whole = std::floor(-samples), share = -samples - whole;
  const auto at = [&](double k) {
    return y[static_cast<Eigen::Index>(std::min(std::max(k, 0.0), static_cast<double>(last)))];
  };
  Eigen::VectorXd later(y.size());
  for (Eigen::Index k = 0; k <= last; ++k) {
    const double left = static_cast<double>(k) + whole;
    const double y0 = at(left), y1 = at(left + 1);
    const double slope0 = 0.5 * (y1 - at(left - 1)), slope1 = 0.5 * (at(left + 2) - y0);
    const double square = 3 * (y1 - y0) - 2 * slope0 - slope1,
                 cube = slope0 + slope1 - 2 * (y1 - y0);
    later[k] = y0 + share * (slope0 + share * (square + share * cube));
  }
  return later;
}

Eigen::VectorXd leadLag(const Eigen::VectorXd& y, double lead, double lag) {
  constexpr double kShortest = 0.02;  // [samples] nothing of a shorter lag is left after a sample
  const double time = std::max(lag, kShortest);
  const double kept = std::exp(-1 / time), ramp = 1 - time * (1 - kept);
  Eigen::VectorXd filtered(y.size());
  double state = y.size() > 0 ? y[0] : 0, previous = state;
  for (Eigen::Index k = 0; k < y.size(); ++k) {
    if (k > 0) state = kept * state + (1 - kept) * previous + ramp * (y[k] - previous);
    previous = y[k];
    filtered[k] = lead / time * y[k] + (1 - lead / time) * state;
  }
  return filtered;
}

}  // namespace uncertainty_identification
