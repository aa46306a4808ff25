#include "uncertainty_identification/data/recording.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "data/clean_signal.h"
#include "data/covariates.h"
#include "data/output_sampler.h"
#include "data/text.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

/// Input and output on the grid, before rows without a recent input are removed at both ends.
struct Rows {
  double origin = 0;  ///< [s] of row 0
  std::vector<double> u, y, offsets, input_age, output_age, instants;
  std::vector<std::uint8_t> valid;
};

[[noreturn]] void refuse(const Recording& recording, const std::string& what) {
  throw DataError(named(recording.id) + ": " + what);
}

void checkOutputStamps(const Recording& recording, const CleanSignal& output, double sample_time,
                       const ResamplingOptions& options) {
  if (!(sample_time > 0)) {
    refuse(recording, "the output has a single stamp (" + text(output.stamps.front()) + " s, " +
                          std::to_string(output.duplicate_stamps) +
                          " duplicates), from which no sample time follows; record at least two "
                          "samples whose stamps rise");
  }
  const double jitter = output.grid.max_departure;
  if (options.max_jitter > 0 && jitter > options.max_jitter) {
    refuse(recording, "output stamps deviate by up to " + rounded(jitter) +
                          " s from a uniform grid of " + text(output.grid.period) +
                          " s, more than max_jitter " + text(options.max_jitter) +
                          " s; stamp the samples when they are taken, or raise max_jitter");
  }
}

/// [s] how much later than an output an input sample may be and still act on it. The phase between
/// signals that jitter is known only to within this.
double inputSlack(const CleanSignal& input, const CleanSignal& output) {
  if (!input.on_grid || !output.on_grid) return 0;
  return input.grid.typical_departure + output.grid.typical_departure;
}

/// Index of the first output for which the input is known.
double gridOrigin(const Recording& recording, const CleanSignal& input, const CleanSignal& output,
                  double slack) {
  const double known = input.instants.front() - slack;
  const auto first = std::lower_bound(output.instants.begin(), output.instants.end(), known);
  if (first == output.instants.end()) {
    refuse(recording, "the last output (" + text(output.stamps.back()) +
                          " s) precedes the first input (" + text(input.stamps.front()) +
                          " s), so that the two do not overlap; record both with one clock");
  }
  return *first;
}

/// Number of grid points up to the last output. Refuses stamps that are so far apart that they must
/// be wrong.
long gridPoints(const Recording& recording, const CleanSignal& output, double origin, double reach,
                double sample_time) {
  const double steps = std::floor((output.instants.back() + reach - origin) / sample_time);
  if (steps > 10.0 * static_cast<double>(output.stamps.size()) + 1e6) {
    refuse(recording, "the output's " + std::to_string(output.stamps.size()) + " samples (" +
                          std::to_string(output.zero_stamps) + " stamped 0) spread from " +
                          text(output.stamps.front()) + " s to " + text(output.stamps.back()) +
                          " s at a sample time of " + text(sample_time) +
                          " s; fill in the stamp of every header, all from one clock");
  }
  return static_cast<long>(steps) + 1;
}

Rows fillRows(const CleanSignal& input, const OutputSampler& sampler, double origin, long points,
              double sample_time, double slack) {
  Rows rows;
  rows.origin = origin;
  for (long k = 0; k < points; ++k) {
    const double point = origin + static_cast<double>(k) * sample_time;
    const OutputSample sample = sampler.at(point);
    const bool measured = std::isfinite(sample.value);
    rows.y.push_back(measured ? sample.value : 0);
    rows.valid.push_back(measured);
    rows.offsets.push_back(measured ? sample.offset : 0);
    rows.output_age.push_back(measured ? sample.age : 0);
    const double latest = sample.instant + slack + stampTolerance(point, sample_time);
    const auto newest =
        static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, input.newestAt(latest)));
    rows.u.push_back(input.values[newest]);
    rows.input_age.push_back(sample.instant - input.instants[newest]);
    rows.instants.push_back(sample.instant);
  }
  return rows;
}

/// The first row whose input is younger than max_age, and one past the last. The inputs of all rows
/// in between must be younger, too.
std::pair<std::size_t, std::size_t> freshRows(const Recording& recording, const Rows& rows,
                                              double max_age, double sample_time) {
  std::size_t first = 0, last = rows.u.size();
  if (!(max_age > 0)) return {first, last};
  const auto stale = [&](std::size_t k) {
    return rows.input_age[k] > max_age + stampTolerance(rows.instants[k], sample_time);
  };
  while (first < last && stale(first)) ++first;
  while (last > first && stale(last - 1)) --last;
  for (std::size_t k = first; k < last; ++k) {
    if (!stale(k)) continue;
    refuse(recording, "the input is " + rounded(rows.input_age[k]) + " s old at " +
                          text(rows.instants[k]) + " s, more than max_age " + text(max_age) +
                          " s; record the input without gaps, or raise max_age if the actuator "
                          "keeps its value that long");
  }
  if (first == last) {
    refuse(recording, "no output has an input younger than max_age " + text(max_age) +
                          " s; publish the input while the experiment runs, or raise max_age");
  }
  return {first, last};
}

template <typename T>
void keep(std::vector<T>& values, std::size_t first, std::size_t last) {
  values.erase(values.begin() + static_cast<std::ptrdiff_t>(last), values.end());
  values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(first));
}

void trim(Rows& rows, std::size_t first, std::size_t last, double sample_time) {
  rows.origin += static_cast<double>(first) * sample_time;
  for (auto* column :
       {&rows.u, &rows.y, &rows.offsets, &rows.input_age, &rows.output_age, &rows.instants}) {
    keep(*column, first, last);
  }
  keep(rows.valid, first, last);
}

/// [s] until when a covariate may have come to belong to a row: its instant, or the stamp of its
/// output where that is later, so that what bears the same stamp belongs together.
std::vector<double> covariateTimes(const Rows& rows, double sample_time) {
  std::vector<double> times = rows.instants;
  for (std::size_t k = 0; k < times.size(); ++k)
    times[k] =
        std::max(times[k], rows.origin + static_cast<double>(k) * sample_time + rows.offsets[k]);
  return times;
}

Eigen::VectorXd asVector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

Experiment assemble(const Recording& recording, const Rows& rows, double sample_time,
                    bool with_offsets) {
  Experiment experiment;
  experiment.id = recording.id;
  experiment.sample_time = sample_time;
  experiment.start_time = rows.origin;
  experiment.u = asVector(rows.u);
  experiment.y = asVector(rows.y);
  if (std::count(rows.valid.begin(), rows.valid.end(), 0) > 0) experiment.valid = rows.valid;
  if (with_offsets) experiment.stamp_offset = asVector(rows.offsets);
  addCovariates(recording, covariateTimes(rows, sample_time), experiment);
  return experiment;
}

SignalTiming timingOf(const StampedSignal& signal, const SampleGrid& grid) {
  SignalTiming timing = timingOf(signal);
  if (grid.one_to_one) timing.jitter = grid.max_departure;
  return timing;
}

ResamplingReport makeReport(const Recording& recording, const CleanSignal& input,
                            const CleanSignal& output, const Rows& rows,
                            const Experiment& experiment) {
  ResamplingReport report;
  report.id = recording.id;
  report.sample_time = experiment.sample_time;
  report.input_period = input.grid.period;
  report.output_period = output.grid.period;
  report.max_jitter = output.grid.max_departure;
  report.max_age = std::max({0.0, *std::max_element(rows.input_age.begin(), rows.input_age.end()),
                             *std::max_element(rows.output_age.begin(), rows.output_age.end())});
  report.missing_outputs = experiment.samples() - experiment.validSamples();
  report.duplicate_stamps =
      recording.duplicate_stamps + input.duplicate_stamps + output.duplicate_stamps;
  report.zero_stamps = input.zero_stamps + output.zero_stamps;
  report.stray_stamps = recording.stray_stamps + input.stray_stamps + output.stray_stamps;
  return report;
}

}  // namespace

Experiment resample(const Recording& recording, double sample_time,
                    const ResamplingOptions& options, ResamplingReport* report) {
  CleanSignal input = cleanSignal(recording.input, recording.id, "input", Duplicates::keep_last);
  CleanSignal output = cleanSignal(recording.output, recording.id, "output", Duplicates::keep_first,
                                   recording.start, recording.end);
  if (!(sample_time > 0)) sample_time = output.grid.period;
  checkOutputStamps(recording, output, sample_time, options);
  input.removeJitter(sample_time);
  output.removeJitter(sample_time);

  const OutputSampler sampler(output, sample_time, options);
  const double slack = inputSlack(input, output);
  const double last = output.instants.back();
  const double origin =
      gridOrigin(recording, input, output, slack + stampTolerance(last, sample_time));
  const long points = gridPoints(recording, output, origin, sampler.reach(last), sample_time);
  Rows rows = fillRows(input, sampler, origin, points, sample_time, slack);
  const auto [first_fresh, last_fresh] = freshRows(recording, rows, options.max_age, sample_time);
  trim(rows, first_fresh, last_fresh, sample_time);

  const bool jitters = output.grid.max_departure > stampTolerance(last, sample_time);
  const bool with_offsets = options.output == OutputResampling::hold && jitters;
  Experiment experiment = assemble(recording, rows, sample_time, with_offsets);
  experiment.timing = {timingOf(recording.input, input.grid),
                       timingOf(recording.output, output.grid)};
  if (report != nullptr) *report = makeReport(recording, input, output, rows, experiment);
  return experiment;
}

std::vector<std::string> ResamplingReport::warnings() const {
  std::vector<std::string> found;
  const auto warn = [&](const std::string& what) { found.push_back(named(id) + ": " + what); };
  if (duplicate_stamps > 0) {
    warn(std::to_string(duplicate_stamps) +
         " samples have the same stamp as another, so that only one of them is used; stamp each "
         "sample when it is taken");
  }
  if (zero_stamps > 2) {  // one of the input and one of the output are plausible
    warn(std::to_string(zero_stamps) + " samples are stamped 0; fill in header.stamp");
  }
  if (stray_stamps > 0) {
    warn(std::to_string(stray_stamps) +
         " samples are left out, whose stamps lie before or far ahead of those around them; stamp "
         "the samples of a signal in one place and by one clock");
  }
  if (!false_readings.empty()) warn(false_readings);
  if (max_jitter > 0.1 * sample_time) {
    warn("output stamps deviate by up to " + rounded(max_jitter) + " s from a uniform grid of " +
         text(output_period) + " s; stamp the samples when they are taken");
  }
  if (missing_outputs > 0) {
    warn(std::to_string(missing_outputs) + " grid points have no output and count as missing");
  }
  if (max_age > 3.5 * sample_time && max_age > 1.5 * input_period) {
    warn("an input value was held for " + rounded(max_age) +
         " s; make sure that the actuator kept it that long, too");
  }
  return found;
}

}  // namespace uncertainty_identification
