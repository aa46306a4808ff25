#pragma once

#include <gtest/gtest.h>

#include <string>

#include "data/experiment_cutter.h"

/// Signals and options for tests of the experiment cutter.
namespace uncertainty_identification {
namespace test {

constexpr double kStep = 0.125;  // [s], exact in binary, so that stamps can be compared

inline ExperimentOptions mode(ExperimentMode mode, double seconds = 0) {
  ExperimentOptions options;
  options.mode = mode;
  options.duration = options.gap = seconds;
  return options;
}

inline LimitOptions limit(int max_samples) {
  LimitOptions limits;
  limits.max_samples = max_samples;
  return limits;
}

/// Both signals at from, from + kStep, ... up to but without `to`; the value of a sample is its
/// stamp, with the other sign for the output.
inline void feed(ExperimentCutter& cutter, double from, double to) {
  for (double stamp = from; stamp < to; stamp += kStep) {
    cutter.addInput(stamp, stamp);
    cutter.addOutput(stamp, -stamp);
  }
}

inline void expectSpan(const StampedSignal& signal, double first, double last) {
  ASSERT_FALSE(signal.stamps.empty());
  EXPECT_EQ(signal.stamps.front(), first);
  EXPECT_EQ(signal.stamps.back(), last);
}

}  // namespace test
}  // namespace uncertainty_identification
