#include "data/stray_readings.h"

#include <algorithm>
#include <cmath>

#include "data/text.h"

namespace uncertainty_identification {
namespace {

constexpr int kAround = 2;  // neighbours on each side

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// How a sample lies among the four around it.
struct Place {
  int sample;
  double distance;  ///< from their mean
  double spread;    ///< of the four: the largest less the smallest
};

/// Of the samples that were measured, as were all around them.
std::vector<Place> placesOf(const Eigen::VectorXd& signal, const Experiment& experiment,
                            bool is_output) {
  std::vector<Place> places;
  for (int t = kAround; t < experiment.samples() - kAround; ++t) {
    double sum = 0, low = signal[t - 1], high = signal[t - 1];
    bool measured = !is_output || experiment.isValid(t);
    for (const int k : {t - 2, t - 1, t + 1, t + 2}) {
      measured = measured && (!is_output || experiment.isValid(k));
      sum += signal[k];
      low = std::min(low, signal[k]);
      high = std::max(high, signal[k]);
    }
    if (measured) places.push_back({t, std::abs(signal[t] - sum / 4), high - low});
  }
  return places;
}

std::vector<Place> straysOf(const Eigen::VectorXd& signal, const Experiment& experiment,
                            bool is_output) {
  constexpr double kUsual = 0.95, kFar = 8, kOfRange = 0.05, kClose = 0.25;
  std::vector<Place> places = placesOf(signal, experiment, is_output);
  std::vector<double> distances, values;
  for (const Place& place : places) {
    distances.push_back(place.distance);
    values.push_back(signal[place.sample]);
  }
  constexpr double kEnds = 0.05;  // not counted as range, so that strays themselves are not
  const double range = quantile(values, 1 - kEnds) - quantile(values, kEnds);
  const double least = std::max(kFar * quantile(distances, kUsual), kOfRange * range);
  places.erase(std::remove_if(places.begin(), places.end(),
                              [&](const Place& place) {
                                return !(place.distance > least) ||
                                       place.spread > kClose * place.distance;
                              }),
               places.end());
  return places;
}

/// Whether a pulse of the input may be what the output answers to.
bool followsPulse(int sample, const std::vector<Place>& pulses) {
  constexpr int kShortly = 20;
  return std::any_of(pulses.begin(), pulses.end(), [&](const Place& pulse) {
    return pulse.sample <= sample && sample - pulse.sample <= kShortly;
  });
}

}  // namespace

StrayReadings strayReadings(const std::vector<Experiment>& experiments, double most) {
  constexpr int kFewest = 3;
  constexpr double kRarest = 0.001;
  if (!(most > 0)) return {};
  StrayReadings found;
  double measured = 0;
  std::vector<double> sizes;
  for (const Experiment& experiment : experiments) {
    const std::vector<Place> pulses = straysOf(experiment.u, experiment, false);
    std::vector<int> samples;
    for (const Place& place : straysOf(experiment.y, experiment, true)) {
      if (followsPulse(place.sample, pulses)) continue;
      samples.push_back(place.sample);
      sizes.push_back(place.distance);
    }
    measured += experiment.validSamples();
    found.samples.push_back(std::move(samples));
  }
  found.count = static_cast<int>(sizes.size());
  found.share = found.count / std::max(measured, 1.0);
  if (found.count < kFewest || found.share < kRarest || found.share > most) return {};
  found.size = quantile(std::move(sizes), 0.5);
  return found;
}

std::vector<Experiment> without(const StrayReadings& stray, std::vector<Experiment> experiments) {
  for (std::size_t r = 0; r < stray.samples.size(); ++r) {
    Experiment& experiment = experiments[r];
    if (stray.samples[r].empty()) continue;
    experiment.valid.resize(static_cast<std::size_t>(experiment.samples()), 1);
    for (const int t : stray.samples[r]) experiment.valid[static_cast<std::size_t>(t)] = 0;
  }
  return experiments;
}

std::string strayText(const StrayReadings& stray, const std::vector<Experiment>& experiments) {
  if (stray.count == 0) return "";
  std::size_t r = 0;
  while (stray.samples[r].empty()) ++r;
  const Experiment& experiment = experiments[r];
  const int t = stray.samples[r].front();
  return std::to_string(stray.count) + " single readings of the output (" +
         text(std::round(1e4 * stray.share) / 100) +
         " %) stray from both their neighbours, such as " + text(experiment.y[t]) + " between " +
         text(experiment.y[t - 1]) + " and " + text(experiment.y[t + 1]) + " at " +
         text(t * experiment.sample_time) + " s of experiment '" + experiment.id +
         "', and count as missing";
}

}  // namespace uncertainty_identification
