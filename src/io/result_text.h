#pragma once

#include <string>

#include "uncertainty_identification/baselines/baseline.h"
#include "uncertainty_identification/bounds/bounds.h"
#include "uncertainty_identification/estimation/estimate.h"

namespace uncertainty_identification {

/// An estimate as text for people: the plant in physical terms (`sentence`), nominal model with
/// standard errors, mixture, noise variance, how the estimation ended, and, if there are any,
/// candidates of automatic choices, the fit on validation data, rejected experiments with reasons,
/// and warnings. Several lines, ending in a newline.
std::string resultText(const Estimate& estimate, const std::string& sentence = "");

/// The bounds in a few lines: how far the plants deviate from the nominal model, and the weight.
std::string boundsText(const Bounds& bounds);

/// A baseline in a few lines: the spread of the fits of single experiments, and the bands.
std::string baselineText(const Baseline& baseline);

}  // namespace uncertainty_identification
