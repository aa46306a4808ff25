#pragma once

#include <string>

#include "uncertainty_identification/baselines/baseline.h"
#include "uncertainty_identification/bounds/bounds.h"
#include "uncertainty_identification/estimation/estimate.h"

namespace uncertainty_identification {

/// An estimate for people: nominal model with standard errors, mixture, noise variance, how the
/// estimation ended, rejected experiments with their reasons, warnings, candidates of automatic
/// choices and the fit on validation data, as far as there are any. Several lines, ending in a
/// newline.
std::string resultText(const Estimate& estimate);

/// The bounds in a few lines: how far plants depart from the nominal model, and the weight.
std::string boundsText(const Bounds& bounds);

/// A baseline in a few lines: the spread of the experiments' own fits, and its region.
std::string baselineText(const Baseline& baseline);

}  // namespace uncertainty_identification
