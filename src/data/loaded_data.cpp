#include "uncertainty_identification/data/loaded_data.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "data/false_readings.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

/// Two fitted sample times with a smaller relative difference count as equal; jitter explains it.
constexpr double kSameRate = 0.02;

/// Resamples at the sample time of the first experiment (0: there is none yet) if the recording
/// has about the same one.
Experiment resampleAlike(const Recording& recording, double common,
                         const ResamplingOptions& options, ResamplingReport& report) {
  Experiment experiment = resample(recording, 0, options, &report);
  const double own = experiment.sample_time;
  if (own == common || std::abs(own - common) > kSameRate * common) return experiment;
  return resample(recording, common, options, &report);
}

template <typename T>
void moveInto(std::vector<T>& from, std::vector<T>& to) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

}  // namespace

void addResampled(Recording recording, double sample_time, const ResamplingOptions& options,
                  LoadedData& data, double first) {
  try {
    ResamplingReport report;
    StampedSignal &input = recording.input, &output = recording.output;
    std::string false_readings;
    if (input.stamps.size() == input.values.size() && output.stamps.size() == output.values.size())
      false_readings =
          replaceFalseReadings(input.stamps, &input.values, output.stamps, &output.values);
    if (first == 0 && !data.experiments.empty()) first = data.experiments.front().sample_time;
    data.experiments.push_back(sample_time > 0 ? resample(recording, sample_time, options, &report)
                                               : resampleAlike(recording, first, options, report));
    report.false_readings = false_readings;
    for (std::string& warning : report.warnings()) data.warnings.push_back(std::move(warning));
    if (!recording.note.empty()) {
      data.warnings.push_back("experiment '" + recording.id + "': " + recording.note);
    }
  } catch (const DataError& error) {
    data.rejected.push_back({recording.id, error.what()});
  }
}

double sampleTimeForAll(const std::vector<Experiment>& experiments) {
  constexpr double kMost = 30, kShare = 0.8, kLittle = 1.2;
  constexpr double kNoDifference = 1e-3;  // relative, which the checks accept
  if (experiments.empty()) return 0;
  std::vector<double> times;
  times.reserve(experiments.size());
  for (const Experiment& experiment : experiments) times.push_back(experiment.sample_time);
  std::sort(times.begin(), times.end());
  const double count = static_cast<double>(times.size());
  const auto enough = static_cast<std::size_t>(std::ceil(kShare * count));
  const double of_most = times[enough - 1];  // those that are little slower are no reason to stop
  const double shortest = times.front(),
               longest =
                   *std::prev(std::upper_bound(times.begin(), times.end(), kLittle * of_most));
  if (longest > kMost * shortest || longest <= (1 + kNoDifference) * shortest) return 0;
  return longest > (1 + kSameRate) * shortest ? longest : times[times.size() / 2];
}

void append(LoadedData more, LoadedData& data) {
  moveInto(more.experiments, data.experiments);
  moveInto(more.rejected, data.rejected);
  moveInto(more.warnings, data.warnings);
}

}  // namespace uncertainty_identification
