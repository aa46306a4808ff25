#pragma once

#include <optional>
#include <string>
#include <vector>

#include "explanation/split.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/effects/effect.h"
#include "uncertainty_identification/explanation/explanation.h"

/// Checks of the samples for defects of the sensor that show without a model: a measurement with
/// continuous noise never repeats a value exactly.
namespace uncertainty_identification {

/// A defect of the sensor that spoils samples.
struct SpoiltSamples {
  Trait trait;  ///< of the effect: quantisation, output_limit, held_samples or outliers
  std::vector<CauseParameter> parameters;
};

/// The experiments from just before the first change of input or output on. A recording of a system
/// at rest repeats values though its sensor neither hangs nor is at a limit; the last three samples
/// stay, as they show where it rested.
std::vector<Experiment> withoutRest(std::vector<Experiment> experiments);

/// The defects found: quantisation alone, or clipping or held samples or both.
std::vector<SpoiltSamples> checkSamples(const std::vector<Experiment>& experiments);

/// Whether other experiments, in which the sensor reads beyond a limit, show that it is none.
bool isExceeded(const SpoiltSamples& limit, const std::vector<Experiment>& others);

/// The experiments with the spoilt samples masked: those at a limit of the sensor, or those that
/// repeat the sample before. Quantisation spoils no single sample.
std::vector<Experiment> withoutSpoiled(std::vector<Experiment> experiments,
                                       const SpoiltSamples& defect);

/// Masks single readings that stray from their neighbours (data/stray_readings.h), unless they are
/// excluded by name; those that are left count as none. Absent where there are none.
std::optional<SpoiltSamples> maskStray(Configuration* configuration, Split* data);

/// Masks the samples that are spoilt in the experiments to fit to and in the held-out ones, and
/// returns the defects: all that are neither excluded by name nor disproved by held-out
/// experiments, and `stray`, which are masked already. The configuration then allows any share of
/// masked samples.
std::vector<SpoiltSamples> maskSpoilt(const std::optional<SpoiltSamples>& stray,
                                      Configuration* configuration, Split* data);

}  // namespace uncertainty_identification
