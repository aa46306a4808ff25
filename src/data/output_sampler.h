#pragma once

#include "data/clean_signal.h"
#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

/// The output at a grid point.
struct OutputSample {
  double value = 0;    ///< NaN: missing
  double offset = 0;   ///< [s] actual minus nominal instant of the sample taken (hold)
  double age = 0;      ///< [s] of the sample held (hold)
  double instant = 0;  ///< [s] at which the input belonging to it is read
};

/// Reads an output signal at the points of a grid. Keeps references to its arguments.
class OutputSampler {
 public:
  OutputSampler(const CleanSignal& output, double sample_time, const ResamplingOptions& options);

  /// [s] how far a sample may lie behind a grid point and still belong to it: half a period where
  /// the output is sampled at the grid's rate or a multiple of it (the nearest grid point), else
  /// only rounding.
  double reach(double time) const;

  OutputSample at(double point) const;

 private:
  double maxAge() const;
  OutputSample held(double point) const;
  double interpolated(double point) const;
  double binMean(double point) const;

  const CleanSignal& output_;
  double sample_time_;
  const ResamplingOptions& options_;
  bool matched_;  ///< sampled at the grid's rate or a multiple of it
};

}  // namespace uncertainty_identification
