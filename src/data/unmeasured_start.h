#pragma once

#include <string>
#include <vector>

#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// The experiment without so many of its first samples, which must be fewer than it has.
Experiment withoutFirst(int samples, Experiment experiment);

/// All samples where none is measured.
int samplesBeforeFirstMeasured(const Experiment& experiment);

/// The experiments from their first measured output on, for models whose state is unknown there
/// anyway: inputs before it only move that state. Kept, they would leave directions of an earlier
/// state that no output shows, beside which sums of squares lose their digits. Adds a sentence to
/// `remarks` where some lose more than a twentieth of their samples.
std::vector<Experiment> fromFirstMeasured(std::vector<Experiment> experiments,
                                          std::vector<std::string>* remarks);

}  // namespace uncertainty_identification
