#pragma once

/// The inner loops of piecewise_sweep.h, compiled for several vector units. A signal is given by
/// the address of its first sample in the piece, behind which its past samples lie; a sample
/// consists of kLanes numbers. `lanes` is the number of lanes in use; what is in the others is not
/// defined.
namespace uncertainty_identification {

/// A rational filter (n0 + n1 q^-1 + ...)/(1 + d1 q^-1 + ...). Without numerator it is all-pole.
struct PieceFilter {
  const double* numerator;
  int zeros;  ///< number of numerator coefficients
  const double* denominator;
  int poles;
};

struct SweepKernels {
  /// Filters `samples` samples of several signals. A signal and its result may be the same for an
  /// all-pole filter.
  void (*filter)(const PieceFilter& by, const double* const* in, int signals, int samples,
                 int lanes, double* const* out);

  /// out = left - right - constant, with a constant for each lane.
  void (*subtract)(const double* left, const double* right, const double* constant, int samples,
                   int lanes, double* out);

  /// Adds the inner products left_i'right_j of each lane to sums[i rights + j].
  void (*products)(const double* const* left, int lefts, const double* const* right, int rights,
                   int samples, int lanes, double* sums);

  /// The same for signals `left` that all lanes share: a sample is a single number.
  void (*sharedProducts)(const double* const* left, int lefts, const double* const* right,
                         int rights, int samples, int lanes, double* sums);
};

/// The version for the processor that the program runs on.
const SweepKernels& sweepKernels();

}  // namespace uncertainty_identification
