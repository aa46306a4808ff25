#pragma once

#include <vector>

#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// Whether the spectrum of the input has a line, in half of the experiments or more, at this
/// frequency [rad/sample], or at a half to a fifth of it: what a model lacks of the response to a
/// sine, or a harmonic of it, looks like hum.
bool mayComeFromInput(double frequency, const std::vector<Experiment>& experiments);

}  // namespace uncertainty_identification
