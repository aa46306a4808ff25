#pragma once

#include <map>
#include <string>
#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// A signal as it was received: one stamp [s] and one value per message, in order of arrival.
struct StampedSignal {
  std::vector<double> stamps;  ///< [s]
  std::vector<double> values;
  std::vector<double> arrivals = {};  ///< [s] of each, NaN where not known; empty: of none
  long lost = 0;                      ///< messages missing between them, by sequence numbers
};

/// Which of several samples with the same stamp is used: for the output the first, for signals that
/// are held (input, covariates) the last, because its value is the one that lasts.
enum class Duplicates { keep_first, keep_last };

/// The signals of one experiment as they were received, before resampling.
struct Recording {
  std::string id;
  /// [s] the cuts: outputs with start <= stamp < end count; all of them if end <= start
  double start = 0, end = 0;
  /// the input may begin before `start`, with the value that acted when the experiment began
  StampedSignal input, output;
  std::map<std::string, StampedSignal> covariates;
  int duplicate_stamps = 0;  ///< samples already left out because another has the same stamp
  int stray_stamps = 0;      ///< samples already left out because their stamps strayed
  std::string note;          ///< why it ended before its proper end; empty: it did not
};

/// What resampling found about the stamps of one recording.
struct ResamplingReport {
  std::string id;
  double sample_time = 0;      ///< [s] used
  double input_period = 0;     ///< [s] median spacing of the stamps, refined (sample_grid.h)
  double output_period = 0;    ///< [s] the same of the output
  double max_jitter = 0;       ///< [s] largest departure of output stamps from a uniform grid
  double max_age = 0;          ///< [s] oldest sample that was held
  int missing_outputs = 0;     ///< grid points without an output within max_age
  int duplicate_stamps = 0;    ///< samples left out because another has the same stamp
  int zero_stamps = 0;         ///< samples stamped 0
  int stray_stamps = 0;        ///< samples left out because their stamps lay before or far ahead of
                               ///< those around them
  std::string false_readings;  ///< a sentence about those that addResampled() replaced; empty: none

  /// What a user should know: duplicates, zero and stray stamps, false readings, jitter above a
  /// tenth of the sample time, missing outputs, an input held for more than three sample times. One
  /// sentence each; empty when all is well.
  std::vector<std::string> warnings() const;
};

/// Puts a recording on a uniform grid: zero-order hold for u; hold, linear interpolation or bin
/// mean for y.
///
/// - sample_time 0: the period of the output's stamps (fitSampleGrid).
/// - The grid starts at the first output at or after the start at which the input is known, so that
/// signals stamped
///   uniformly at sample_time come back bit by bit. Stamps that jitter around a grid of about the
///   sample time count as at the instants they were due, so that jitter shifts no sample; with
///   `hold` the departures are kept in Experiment::stamp_offset.
/// - An output older than options.max_age (0: three sample times) is missing (valid = 0), and so is
/// a non-finite one.
///   `mean` averages the bin of one sample time centred on the grid point.
/// - The input is held until its next sample. Where options.max_age is set, an older input ends the
/// experiment at its
///   edges and is an error in between; with 0 its age is only reported.
/// - Covariates are held (before their first sample: that one); constant ones become scalars.
///
/// Isolated samples, up to one in twenty, whose stamps go back or leap ahead are left out and
/// counted.
///
/// Throws DataError, naming the experiment and what to record instead, for stamps that go back and
/// stay there or are not finite, an empty signal, no samples in common, an input too old in
/// between, jitter above options.max_jitter.
Experiment resample(const Recording& recording, double sample_time,
                    const ResamplingOptions& options, ResamplingReport* report = nullptr);

}  // namespace uncertainty_identification
