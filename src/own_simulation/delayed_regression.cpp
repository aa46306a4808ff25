#include "own_simulation/delayed_regression.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace uncertainty_identification {
namespace {

using Eigen::Index;

/// Squared error of y on 1 and `column`, with weights.
double errorOf(const Eigen::ArrayXd& y, const Eigen::ArrayXd& weight,
               const Eigen::ArrayXd& column) {
  const double count = weight.sum();
  const Eigen::ArrayXd x = weight * (column - (weight * column).sum() / count);
  const Eigen::ArrayXd v = weight * (y - (weight * y).sum() / count);
  const double power = x.square().sum(), product = (x * v).sum();
  return v.square().sum() - (power > 0 ? product * product / power : 0);
}

struct Rows {
  Eigen::MatrixXd columns;
  Eigen::VectorXd y;
};

constexpr int kMargin = 2;  // [samples] around `centre` in which the rows stay the same

/// 1, the delayed signal and its derivative, where the signal is known for all delays of `centre`
/// +- kMargin: rows that came and went with the delay would keep it from converging.
Rows rowsAt(double delay, int centre, const Eigen::VectorXd& y, const Eigen::ArrayXd& weight,
            const ShiftedSignal& y_sim) {
  const Index first = std::max(0, centre + kMargin);
  const Index last = y.size() - 1 + std::min(0, centre - kMargin);
  const ShiftedSignal::Part part = y_sim.delayed(delay, first, last);
  const Eigen::ArrayXd used = weight.segment(first, last - first);
  Rows rows;
  rows.columns.resize(last - first, 3);
  rows.columns << used.matrix(), (used * part.value.array()).matrix(),
      (used * part.slope.array()).matrix();
  rows.y = used * y.segment(first, last - first).array();
  return rows;
}

}  // namespace

int bestShift(const Eigen::VectorXd& y, const Eigen::ArrayXd& weight, const Eigen::VectorXd& y_sim,
              int most) {
  constexpr double kBetter = 0.99;
  constexpr Index kEnough = 20000;          // samples that are compared
  const Index count = y.size() - 2 * most;  // those that every shift has
  const Index stride = 1 + count / kEnough;
  const auto thinned = [&](const auto& signal, Index from) -> Eigen::ArrayXd {
    return Eigen::Map<const Eigen::ArrayXd, 0, Eigen::InnerStride<>>(
        signal.data() + from, 1 + (count - 1) / stride, Eigen::InnerStride<>(stride));
  };
  const Eigen::ArrayXd middle = thinned(y, most), used = thinned(weight, most);
  if (used.sum() == 0) return 0;
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int size = 0; size <= most; ++size)
    for (const int shift : {size, -size}) {
      const double error = errorOf(middle, used, thinned(y_sim, most - shift));
      if (!(error < kBetter * least)) continue;
      least = error;
      best = shift;
    }
  return best;
}

std::optional<DelayedRegression> regressDelayed(const Eigen::VectorXd& y,
                                                const Eigen::ArrayXd& weight,
                                                const ShiftedSignal& y_sim, int start, int most) {
  constexpr int kMostSteps = 50;
  constexpr double kLongestStep = 2, kConverged = 1e-6;  // [samples]
  constexpr double kIndependent = 1e-4;
  DelayedRegression found;
  found.delay = start;
  int centre = start;
  for (int i = 0; i < kMostSteps; ++i) {
    const Rows rows = rowsAt(found.delay, centre, y, weight, y_sim);
    if (independentShare(rows.columns) < kIndependent) return std::nullopt;
    const Eigen::VectorXd c = leastSquares(rows.columns, rows.y);
    const double step = -c[2] / c[1];  // gain y_sim(t - delay - step), linearised
    if (!std::isfinite(step)) return std::nullopt;
    if (std::abs(step) < kConverged) {
      found.of_slopes = regress(rows.columns, rows.y);
      return found;
    }
    found.delay += std::clamp(step, -kLongestStep, kLongestStep);
    if (std::abs(found.delay) > most) return std::nullopt;
    if (std::abs(found.delay - centre) > kMargin)
      centre = static_cast<int>(std::lround(found.delay));
  }
  return std::nullopt;
}

}  // namespace uncertainty_identification
