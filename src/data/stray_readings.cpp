#include "data/stray_readings.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "data/text.h"
#include "math/distributions.h"

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
std::vector<Place> placesOf(const Experiment& experiment) {
  const Eigen::VectorXd& y = experiment.y;
  std::vector<Place> places;
  for (int t = kAround; t < experiment.samples() - kAround; ++t) {
    double sum = 0, low = y[t - 1], high = y[t - 1];
    bool measured = experiment.isValid(t);
    for (const int k : {t - 2, t - 1, t + 1, t + 2}) {
      measured = measured && experiment.isValid(k);
      sum += y[k];
      low = std::min(low, y[k]);
      high = std::max(high, y[k]);
    }
    if (measured) places.push_back({t, std::abs(y[t] - sum / 4), high - low});
  }
  return places;
}

/// The smallest step between two values that differ.
double resolutionOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < values.size(); ++k)
    if (values[k] > values[k - 1]) least = std::min(least, values[k] - values[k - 1]);
  return least;
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

std::vector<Place> straysOf(const Experiment& experiment) {
  constexpr double kFar = 8, kMany = 0.75, kNearlyAll = 0.95, kSteps = 3;
  constexpr double kOfRange = 0.05, kEnds = 0.05;  // not counted, as strays may be there
  const std::vector<Place> places = placesOf(experiment);
  std::vector<double> values;
  values.reserve(places.size());
  for (const Place& place : places) values.push_back(experiment.y[place.sample]);
  const double range = quantile(values, 1 - kEnds) - quantile(values, kEnds);
  const double least = std::max({kFar * quantile(distancesOf(places, {}), kMany), kOfRange * range,
                                 kSteps * resolutionOf(std::move(values))});
  const std::vector<Place> suspects = fartherThan(least, places);
  return fartherThan(kFar * quantile(distancesOf(places, suspects), kNearlyAll), suspects);
}

/// Whether the sample lies at most six behind a change of the input that is half as large as its
/// largest one.
bool isBehindChange(const Eigen::VectorXd& u, int sample) {
  constexpr int kReach = 6;
  constexpr double kLarge = 0.5;
  double largest = 0, near = 0;
  for (int t = 1; t < u.size(); ++t) {
    const double change = std::abs(u[t] - u[t - 1]);
    largest = std::max(largest, change);
    if (t <= sample && t >= sample - kReach) near = std::max(near, change);
  }
  return near > 0 && near >= kLarge * largest;
}

/// Those that lie farther from their neighbours than three times the range of all other readings,
/// and not behind a large change of the input, which a plant may answer with a single reading:
/// neither is noise with heavy tails, however few they are.
std::vector<Place> wild(const std::vector<Place>& strays, const Experiment& experiment) {
  constexpr double kRanges = 3;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  auto next = strays.begin();
  for (int t = 0; t < experiment.samples(); ++t) {
    if (next != strays.end() && next->sample == t) {
      ++next;
    } else if (experiment.isValid(t)) {
      low = std::min(low, experiment.y[t]);
      high = std::max(high, experiment.y[t]);
    }
  }
  std::vector<Place> found;
  std::copy_if(strays.begin(), strays.end(), std::back_inserter(found), [&](const Place& place) {
    return high > low && place.distance > kRanges * (high - low) &&
           !isBehindChange(experiment.u, place.sample);
  });
  return found;
}

/// Changes of the input that are larger than nine tenths of all, at the samples from which they
/// act.
std::vector<int> largeChangesOf(const Eigen::VectorXd& u) {
  constexpr double kMost = 0.9;
  std::vector<double> sizes;
  for (Eigen::Index t = 1; t < u.size(); ++t) sizes.push_back(std::abs(u[t] - u[t - 1]));
  const double least = quantile(sizes, kMost);
  std::vector<int> changes;
  for (std::size_t t = 0; t < sizes.size(); ++t)
    if (sizes[t] > least) changes.push_back(static_cast<int>(t) + 1);
  return changes;
}

/// p-value of so many readings at most `reach` samples behind a large change of the input: of the
/// binomial distribution, if they lay anywhere.
double behindChanges(const std::vector<std::vector<int>>& readings,
                     const std::vector<Experiment>& experiments, int reach) {
  double samples = 0, behind = 0, found = 0, found_behind = 0;
  for (std::size_t r = 0; r < experiments.size(); ++r) {
    std::vector<char> is_behind(static_cast<std::size_t>(experiments[r].samples()), 0);
    for (const int change : largeChangesOf(experiments[r].u))
      std::fill_n(is_behind.begin() + change,
                  std::min(reach, static_cast<int>(is_behind.size()) - change), 1);
    samples += static_cast<double>(is_behind.size());
    behind += static_cast<double>(std::count(is_behind.begin(), is_behind.end(), 1));
    found += static_cast<double>(readings[r].size());
    for (const int t : readings[r]) found_behind += is_behind[static_cast<std::size_t>(t)];
  }
  if (found_behind == 0 || behind == samples) return 1;
  return binomialTail(found_behind - 1, found, behind / samples);
}

/// Whether what leaves its neighbours does so in answer to the input.
bool answersInput(const std::vector<std::vector<int>>& readings,
                  const std::vector<Experiment>& experiments) {
  constexpr double kImprobable = 0.01;
  return behindChanges(readings, experiments, 6) < kImprobable ||
         behindChanges(readings, experiments, 20) < kImprobable;
}

}  // namespace

StrayReadings strayReadings(const std::vector<Experiment>& experiments, double most,
                            bool expected) {
  constexpr int kFewest = 3;
  constexpr double kRarest = 0.001;
  if (!(most > 0)) return {};
  std::vector<std::vector<Place>> strays;
  double measured = 0, count = 0;
  for (const Experiment& experiment : experiments) {
    strays.push_back(straysOf(experiment));
    measured += experiment.validSamples();
    count += static_cast<double>(strays.back().size());
  }
  if (!expected && (count < kFewest || count < kRarest * measured))
    for (std::size_t r = 0; r < strays.size(); ++r) strays[r] = wild(strays[r], experiments[r]);
  StrayReadings found;
  std::vector<double> sizes;
  for (const std::vector<Place>& of_one : strays) {
    found.samples.emplace_back();
    for (const Place& place : of_one) {
      found.samples.back().push_back(place.sample);
      sizes.push_back(place.distance);
    }
  }
  found.count = static_cast<int>(sizes.size());
  found.share = found.count / std::max(measured, 1.0);
  if (found.count == 0 || found.share > most || answersInput(found.samples, experiments)) return {};
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
         "', and count as missing (limits.max_stray: 0 keeps them)";
}

}  // namespace uncertainty_identification
