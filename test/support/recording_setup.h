#pragma once

#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "uncertainty_identification/data/recording.h"
#include "uncertainty_identification/errors.h"

/// Recordings for tests of resampling.
namespace uncertainty_identification {
namespace test {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

/// value(i) = base + i at start + i * period.
inline StampedSignal ramp(double start, double period, int count, double base) {
  StampedSignal signal;
  for (int i = 0; i < count; ++i) {
    signal.stamps.push_back(start + i * period);
    signal.values.push_back(base + i);
  }
  return signal;
}

inline Recording recordingOf(StampedSignal input, StampedSignal output) {
  Recording recording;
  recording.id = "run";
  recording.input = std::move(input);
  recording.output = std::move(output);
  return recording;
}

inline StampedSignal random(double start, double period, int count, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  StampedSignal signal = ramp(start, period, count, 0);
  for (double& value : signal.values) value = normal(engine);
  return signal;
}

inline std::string messageOf(const Recording& recording, double sample_time,
                             const ResamplingOptions& options = {}) {
  try {
    resample(recording, sample_time, options);
  } catch (const DataError& error) {
    return error.what();
  }
  return "";
}

}  // namespace test
}  // namespace uncertainty_identification
