#include "inspection/held_signal.h"

namespace uncertainty_identification {

Eigen::VectorXd heldSignal(const StampedSignal& signal, double start, double period,
                           Eigen::Index count) {
  constexpr double kRounding = 1e-3;  // [periods] a stamp so little late still counts
  Eigen::VectorXd held(count);
  std::size_t at = 0;
  for (Eigen::Index k = 0; k < count; ++k) {
    const double time = start + (static_cast<double>(k) + kRounding) * period;
    while (at + 1 < signal.stamps.size() && signal.stamps[at + 1] <= time) ++at;
    held[k] = signal.values[at];
  }
  return held;
}

}  // namespace uncertainty_identification
