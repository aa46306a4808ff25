#pragma once

#include "data/clean_signal.h"
#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

/// The output at a grid point.
struct OutputSample {
  double value = 0;    ///< NaN: missing
  double offset = 0;   ///< [s] actual minus nominal sampling instant (hold)
  double age = 0;      ///< [s] time since the sample was taken (hold)
  double instant = 0;  ///< [s] when to read the input that belongs to it
};

/// Reads an output signal at the points of a grid. Keeps references to its arguments.
class OutputSampler {
 public:
  OutputSampler(const CleanSignal& output, double sample_time, const ResamplingOptions& options);

  /// [s] how much later than a grid point a sample may be and still belong to it. Half a period if
  /// the output is sampled at the grid's rate or a multiple of it, so that a sample belongs to the
  /// nearest grid point; otherwise only the rounding error of stamps.
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
