#include "data/stray_readings.h"

#include <algorithm>
#include <cmath>
#include <iterator>

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

/// Those of the places that are farther than `least` from their neighbours, which lie close
/// together.
std::vector<Place> fartherThan(double least, const std::vector<Place>& places) {
  constexpr double kClose = 0.25;
  std::vector<Place> far;
  std::copy_if(places.begin(), places.end(), std::back_inserter(far), [&](const Place& place) {
    return place.distance > least && place.spread <= kClose * place.distance;
  });
  return far;
}

/// Distances at the places, without those beside the samples `left_out`, which these make large.
std::vector<double> distancesOf(const std::vector<Place>& places,
                                const std::vector<Place>& left_out) {
  std::vector<double> distances;
  auto near = left_out.begin();
  for (const Place& place : places) {
    while (near != left_out.end() && near->sample + kAround < place.sample) ++near;
    if (near == left_out.end() || near->sample - kAround > place.sample)
      distances.push_back(place.distance);
  }
  return distances;
}

std::vector<Place> straysOf(const Eigen::VectorXd& signal, const Experiment& experiment,
                            bool is_output) {
  constexpr double kFar = 8, kMany = 0.75, kNearlyAll = 0.95;
  constexpr double kOfRange = 0.05, kEnds = 0.05;  // not counted, as strays may be there
  const std::vector<Place> places = placesOf(signal, experiment, is_output);
  std::vector<double> values;
  values.reserve(places.size());
  for (const Place& place : places) values.push_back(signal[place.sample]);
  const double range = quantile(values, 1 - kEnds) - quantile(values, kEnds);
  const std::vector<Place> suspects = fartherThan(
      std::max(kFar * quantile(distancesOf(places, {}), kMany), kOfRange * range), places);
  return fartherThan(kFar * quantile(distancesOf(places, suspects), kNearlyAll), suspects);
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
