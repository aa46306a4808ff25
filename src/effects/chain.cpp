#include "uncertainty_identification/effects/chain.h"

#include <algorithm>
#include <cmath>

#include "uncertainty_identification/model/filter.h"

namespace uncertainty_identification {

using Eigen::Index;

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

Lanes Chain::positions() const {
  Lanes positions = Lanes::Zero();
  for (int lane = 0; lane < block.lanes; ++lane) {
    const int r = block.index[static_cast<std::size_t>(lane)];
    positions[lane] = experiments > 1 ? r / (experiments - 1.0) - 0.5 : 0.0;
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
      const double at = static_cast<double>(t) + shift(lane, t);
      const double whole = std::floor(at), f = at - whole;
      const auto value = [&](Index k) {
        const double index =
            std::clamp(whole + static_cast<double>(k), 0.0, static_cast<double>(samples - 1));
        return x(lane, static_cast<Index>(index));
      };
      out(lane, t) = -f * (f - 1) * (f - 2) / 6 * value(-1) +
                     (f + 1) * (f - 1) * (f - 2) / 2 * value(0) -
                     (f + 1) * f * (f - 2) / 2 * value(1) + (f + 1) * f * (f - 1) / 6 * value(2);
    }
  }
  return out;
}

Signals interpolated(const Signals& x, const Lanes& shift) {
  const Index samples = x.cols();
  Signals out(kLanes, samples);
  Eigen::Array<double, 1, Eigen::Dynamic> from(samples + 3);
  for (int lane = 0; lane < kLanes; ++lane) {
    const double whole = std::floor(shift[lane]), f = shift[lane] - whole;
    for (Index k = 0; k < from.size(); ++k)
      from[k] = x(lane, static_cast<Index>(std::clamp(static_cast<double>(k - 1) + whole, 0.0,
                                                      static_cast<double>(samples - 1))));
    out.row(lane) = -f * (f - 1) * (f - 2) / 6 * from.segment(0, samples) +
                    (f + 1) * (f - 1) * (f - 2) / 2 * from.segment(1, samples) -
                    (f + 1) * f * (f - 2) / 2 * from.segment(2, samples) +
                    (f + 1) * f * (f - 1) / 6 * from.segment(3, samples);
  }
  return out;
}

}  // namespace uncertainty_identification
