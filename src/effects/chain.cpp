#include "uncertainty_identification/effects/chain.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "model/filter.h"

namespace uncertainty_identification {

using Eigen::Index;

namespace {

/// Weights of x(-1), x(0), x(1), x(2) in the cubic through them at f, 0 <= f < 1.
std::array<double, 4> cubicWeights(double f) {
  return {-f * (f - 1) * (f - 2) / 6, (f + 1) * (f - 1) * (f - 2) / 2, -(f + 1) * f * (f - 2) / 2,
          (f + 1) * f * (f - 1) / 6};
}

/// x at a whole instant, the first and last value beyond the ends.
double held(const Signals& x, int lane, double at) {
  return x(lane, static_cast<Index>(std::clamp(at, 0.0, static_cast<double>(x.cols() - 1))));
}

/// Index of a value in a rising sequence, between two of them by interpolation.
double placeAmong(const Eigen::VectorXd& rising, double value) {
  const double* next = std::upper_bound(rising.data(), rising.data() + rising.size(), value);
  const Index k = std::clamp<Index>(next - rising.data(), 1, rising.size() - 1);
  const double share = (value - rising[k - 1]) / (rising[k] - rising[k - 1]);
  return static_cast<double>(k - 1) + std::clamp(share, 0.0, 1.0);
}

}  // namespace

Signals Chain::expected() const {
  Signals sum = x;
  for (int i = 0; i < regressors; ++i) {
    for (int lane = 0; lane < block.lanes; ++lane)
      sum.row(lane) += points(i, lane) * X[static_cast<std::size_t>(i)].row(lane);
  }
  for (const RandomSignal& signal : random) {
    if ((signal.about != 0).any()) sum += signal.z.colwise() * signal.about;
  }
  return sum;
}

void Chain::transform(const Signals& value, const Signals& slope) {
  for (Signals& regressor : X) regressor *= slope;
  for (RandomSignal& signal : random) signal.z *= slope;
  x.setZero();
  x = value - expected();
}

void Chain::filterOutput(const Eigen::VectorXd& numerator, const Eigen::VectorXd& denominator) {
  Signals out;
  const auto put = [&](Signals* signal) {
    filter(numerator, denominator, 0, *signal, &out);
    signal->swap(out);
  };
  put(&x);
  for (Signals& regressor : X) put(&regressor);
  for (RandomSignal& signal : random) put(&signal.z);
}

void Chain::scaleDeviation(const Signals& factor) {
  if (deviation.size() == 0) {
    deviation = factor;
  } else {
    deviation *= factor;
  }
}

Lanes Chain::positions(const Eigen::VectorXd& starts) const {
  Lanes positions = Lanes::Zero();
  for (int lane = 0; lane < block.lanes; ++lane) {
    const auto at = static_cast<std::size_t>(lane);
    if (starts.size() > 1) {
      const double place = placeAmong(starts, block.experiments[at]->start_time);
      positions[lane] = place / static_cast<double>(starts.size() - 1) - 0.5;
    } else if (experiments > 1) {
      positions[lane] = block.index[at] / (experiments - 1.0) - 0.5;
    }
  }
  return positions;
}

Signals Chain::covariate(const std::string& name) const {
  Signals values = Signals::Zero(kLanes, block.samples);
  for (int lane = 0; lane < block.lanes; ++lane) {
    const Experiment& experiment = *block.experiments[static_cast<std::size_t>(lane)];
    const int length = block.lengths[static_cast<std::size_t>(lane)];
    const auto signal = experiment.signals.find(name);
    const auto scalar = experiment.scalars.find(name);
    if (signal != experiment.signals.end()) {
      values.row(lane).head(length) = signal->second.head(length).transpose().array();
    } else if (scalar != experiment.scalars.end()) {
      values.row(lane).head(length).setConstant(scalar->second);
    }
  }
  return values;
}

Eigen::Array<double, 1, Eigen::Dynamic> Chain::time() const {
  return Eigen::Array<double, 1, Eigen::Dynamic>::LinSpaced(block.samples, 0, block.samples - 1);
}

Signals Chain::relativeTime() const {
  Signals share = Signals::Zero(kLanes, block.samples);
  for (int lane = 0; lane < block.lanes; ++lane)
    share.row(lane) = time() / block.lengths[static_cast<std::size_t>(lane)];
  return share;
}

Signals interpolated(const Signals& x, const Signals& shift) {
  const Index samples = x.cols();
  Signals out(kLanes, samples);
  for (Index t = 0; t < samples; ++t) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const double at = static_cast<double>(t) + shift(lane, t), whole = std::floor(at);
      const auto weights = cubicWeights(at - whole);
      out(lane, t) = 0;
      for (int k = 0; k < 4; ++k)
        out(lane, t) += weights[static_cast<std::size_t>(k)] * held(x, lane, whole + k - 1);
    }
  }
  return out;
}

Signals interpolated(const Signals& x, const Lanes& shift) {
  const Index samples = x.cols();
  Signals out = Signals::Zero(kLanes, samples);
  Eigen::Array<double, 1, Eigen::Dynamic> from(samples + 3);
  for (int lane = 0; lane < kLanes; ++lane) {
    const double whole = std::floor(shift[lane]);
    for (Index k = 0; k < from.size(); ++k)
      from[k] = held(x, lane, static_cast<double>(k - 1) + whole);
    const auto weights = cubicWeights(shift[lane] - whole);
    for (int k = 0; k < 4; ++k)
      out.row(lane) += weights[static_cast<std::size_t>(k)] * from.segment(k, samples);
  }
  return out;
}

}  // namespace uncertainty_identification
