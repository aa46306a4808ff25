#pragma once

#include <optional>
#include <vector>

#include "explanation/sample_checks.h"
#include "explanation/split.h"

/// What spoilt samples are masked, so that models are fitted to the others.
namespace uncertainty_identification {

/// Whether other experiments, in which the sensor reads beyond a limit, show that it is none.
bool isExceeded(const SpoiltSamples& limit, const std::vector<Experiment>& others);

/// The experiments with the spoilt samples masked: those at a limit of the sensor, or those that
/// are held. Quantisation spoils no single sample.
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

/// The data with the spoilt samples masked that maskSpoilt() would find, and the rests kept: for
/// the free simulation, which would show a limit or a gap of the sensor as a curve.
Split withoutSpoiltSamples(const Configuration& configuration, Split data);

}  // namespace uncertainty_identification
