#include "explanation/masked_samples.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "data/stray_readings.h"
#include "explanation/held_samples.h"
#include "uncertainty_identification/effects/catalogue.h"

namespace uncertainty_identification {
namespace {

constexpr double kAny = 0.999;  ///< masked samples must not count towards limits.max_missing

bool isExcluded(const std::vector<std::string>& excluded, Trait trait) {
  return std::any_of(excluded.begin(), excluded.end(),
                     [&](const std::string& name) { return hasTrait(name, trait); });
}

/// The defects that are neither excluded by name nor disproved by held-out experiments.
std::vector<SpoiltSamples> spoiltOf(const Configuration& configuration, const Split& data) {
  std::vector<SpoiltSamples> spoilt;
  for (SpoiltSamples& each : checkSamples(withoutRest(data.train)))
    if (!isExcluded(configuration.explanation.exclude, each.trait) && !isExceeded(each, data.held))
      spoilt.push_back(std::move(each));
  return spoilt;
}

/// Masks what a defect has spoilt, unless that leaves too little of a record to explain: of a
/// sensor that reports few values, the held ones are all there is.
void mask(const SpoiltSamples& defect, const LimitOptions& limits, Split* data) {
  std::vector<Experiment> train = withoutSpoiled(data->train, defect);
  if (std::any_of(train.begin(), train.end(), [&](const Experiment& experiment) {
        return experiment.validSamples() < limits.min_samples;
      }))
    return;
  data->train = std::move(train);
  data->held = withoutSpoiled(std::move(data->held), defect);
}

}  // namespace

bool isExceeded(const SpoiltSamples& limit, const std::vector<Experiment>& others) {
  if (limit.trait != Trait::output_limit) return false;
  const double low = limit.parameters.at(0).value, high = limit.parameters.at(1).value;
  for (const Experiment& experiment : others)
    for (int t = 0; t < experiment.samples(); ++t)
      if (experiment.isValid(t) && (experiment.y[t] < low || experiment.y[t] > high)) return true;
  return false;
}

std::vector<Experiment> withoutSpoiled(std::vector<Experiment> experiments,
                                       const SpoiltSamples& defect) {
  if (defect.trait == Trait::quantisation) return experiments;
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const bool clipped = defect.trait == Trait::output_limit;
  const double low = clipped ? defect.parameters[0].value : -kFar;
  const double high = clipped ? defect.parameters[1].value : kFar;
  for (Experiment& experiment : experiments) {
    std::vector<std::uint8_t> valid(static_cast<std::size_t>(experiment.samples()));
    for (int t = 0; t < experiment.samples(); ++t) {
      const bool spoiled = clipped ? experiment.y[t] <= low || experiment.y[t] >= high
                                   : defect.resolution == 0 && isHeld(experiment, t, low, high);
      valid[static_cast<std::size_t>(t)] = experiment.isValid(t) && !spoiled;
    }
    if (defect.resolution > 0)
      for (const HeldRow& gap : gapsOf(experiment, {low, high, defect.resolution}))
        std::fill(valid.begin() + gap.begin, valid.begin() + gap.end, 0);
    experiment.valid = std::move(valid);
  }
  return experiments;
}

std::optional<SpoiltSamples> maskStray(Configuration* configuration, Split* data) {
  double most = 0;
  std::swap(most, configuration->limits.max_stray);
  if (isExcluded(configuration->explanation.exclude, Trait::outliers)) return std::nullopt;
  const StrayReadings stray = strayReadings(data->train, most),
                      stray_held = strayReadings(data->held, most, stray.count > 0);
  data->train = without(stray, std::move(data->train));
  data->held = without(stray_held, std::move(data->held));
  if (stray.count == 0) return std::nullopt;
  configuration->limits.max_missing = kAny;
  return SpoiltSamples{
      Trait::outliers,
      {exactly("share", "1", stray.share), exactly("distance", "unit of y", stray.size)}};
}

std::vector<SpoiltSamples> maskSpoilt(const std::optional<SpoiltSamples>& stray,
                                      Configuration* configuration, Split* data) {
  data->train = withoutRest(std::move(data->train));
  data->held = withoutRest(std::move(data->held));
  std::vector<SpoiltSamples> spoilt = spoiltOf(*configuration, *data);
  for (const SpoiltSamples& each : spoilt) {
    mask(each, configuration->limits, data);
    if (each.trait != Trait::quantisation) configuration->limits.max_missing = kAny;
  }
  if (stray) spoilt.push_back(*stray);
  return spoilt;
}

Split withoutSpoiltSamples(const Configuration& configuration, Split data) {
  for (const SpoiltSamples& each : spoiltOf(configuration, data))
    mask(each, configuration.limits, &data);
  return data;
}

}  // namespace uncertainty_identification
