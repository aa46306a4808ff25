#include "simulation/signals.h"

#include <algorithm>
#include <cmath>

#include "model/filter.h"

namespace uncertainty_identification {

using Eigen::VectorXd;

// The model's filters process kLanes signals at once; here only the first lane is used.
VectorXd filtered(const VectorXd& numerator, const VectorXd& denominator, int delay,
                  const VectorXd& signal) {
  Signals in = Signals::Zero(kLanes, signal.size()), out;
  in.row(0) = signal.array();
  filter(numerator, denominator, delay, in, &out);
  return out.row(0).matrix();
}

VectorXd lagged(double pole, const VectorXd& signal) {
  return filtered(VectorXd::Constant(1, 1 - pole), VectorXd::Constant(1, -pole), 0, signal);
}

VectorXd delayed(const VectorXd& signal, double delay) {
  const int whole = static_cast<int>(std::min<double>(delay, static_cast<double>(signal.size())));
  const double part = delay - std::floor(delay);
  return filtered(Eigen::Vector2d(1 - part, part), VectorXd(), whole, signal);
}

VectorXd resampledAt(const VectorXd& signal, const VectorXd& shift) {
  const auto last = static_cast<double>(signal.size() - 1);
  const auto at = [&](double index) {
    return index < 0 ? 0.0 : signal(static_cast<Eigen::Index>(std::min(index, last)));
  };
  return VectorXd::NullaryExpr(signal.size(), [&](Eigen::Index k) {
    const double instant = static_cast<double>(k) + shift(k), i = std::floor(instant);
    const double f = instant - i;  // Lagrange's polynomial through the samples i - 1 ... i + 2
    return -f * (f - 1) * (f - 2) / 6 * at(i - 1) + (f + 1) * (f - 1) * (f - 2) / 2 * at(i) -
           (f + 1) * f * (f - 2) / 2 * at(i + 1) + (f + 1) * f * (f - 1) / 6 * at(i + 2);
  });
}

VectorXd quantised(double step, const VectorXd& signal) {
  return signal.unaryExpr([step](double value) { return step * std::round(value / step); });
}

double onset(int k, double start) { return std::clamp(k - start + 1, 0.0, 1.0); }

}  // namespace uncertainty_identification
