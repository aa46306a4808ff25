#include "data/output_sampler.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace uncertainty_identification {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// Whether `sample_time` is a multiple of the period, within five per cent.
bool isMultiple(double sample_time, double period) {
  if (!(period > 0)) return true;
  const double ratio = sample_time / period;
  return ratio > 0.95 && std::abs(ratio - std::round(ratio)) <= 0.05 * std::round(ratio);
}

}  // namespace

OutputSampler::OutputSampler(const CleanSignal& output, double sample_time,
                             const ResamplingOptions& options)
    : output_(output),
      sample_time_(sample_time),
      options_(options),
      matched_(isMultiple(sample_time, output.grid.period)) {}

double OutputSampler::reach(double time) const {
  const double rounding = stampTolerance(time, sample_time_);
  return matched_ ? std::max(rounding, 0.5 * output_.grid.period) : rounding;
}

double OutputSampler::maxAge() const {
  return options_.max_age > 0 ? options_.max_age : 3 * sample_time_;
}

OutputSample OutputSampler::at(double point) const {
  OutputSample sample = held(point);
  if (options_.output == OutputResampling::hold) return sample;
  sample.value = options_.output == OutputResampling::linear ? interpolated(point) : binMean(point);
  sample.age = 0;
  return sample;
}

OutputSample OutputSampler::held(double point) const {
  OutputSample sample;
  sample.value = kMissing;
  sample.instant = point;
  const std::ptrdiff_t newest = output_.newestAt(point + reach(point));
  if (newest < 0) return sample;
  const auto i = static_cast<std::size_t>(newest);
  const double age = point - output_.instants[i];
  if (matched_ && age <= 0.5 * sample_time_) sample.instant = output_.instants[i];
  if (age > maxAge() + stampTolerance(point, sample_time_)) return sample;
  sample.value = output_.values[i];
  sample.offset = output_.stamps[i] - point;
  sample.age = age;
  return sample;
}

double OutputSampler::interpolated(double point) const {
  const auto& stamps = output_.stamps;
  const double tolerance = stampTolerance(point, sample_time_);
  const auto after = std::upper_bound(stamps.begin(), stamps.end(), point + tolerance);
  if (after == stamps.begin()) return kMissing;
  const auto i = static_cast<std::size_t>(after - stamps.begin()) - 1;
  const double age = point - stamps[i];
  if (age <= tolerance) return output_.values[i];
  if (after == stamps.end() || age > maxAge() || *after - point > maxAge()) return kMissing;
  return output_.values[i] +
         age / (*after - stamps[i]) * (output_.values[i + 1] - output_.values[i]);
}

double OutputSampler::binMean(double point) const {
  const auto& stamps = output_.stamps;
  const double edge = point - 0.5 * sample_time_ - stampTolerance(point, sample_time_);
  const auto first = std::lower_bound(stamps.begin(), stamps.end(), edge);
  const auto last = std::lower_bound(first, stamps.end(), edge + sample_time_);
  double sum = 0;
  int count = 0;
  for (auto stamp = first; stamp != last; ++stamp) {
    const double value = output_.values[static_cast<std::size_t>(stamp - stamps.begin())];
    if (!std::isfinite(value)) continue;
    sum += value;
    ++count;
  }
  return count > 0 ? sum / count : kMissing;
}

}  // namespace uncertainty_identification
