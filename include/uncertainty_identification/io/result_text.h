#pragma once

#include <string>

#include "uncertainty_identification/estimation/estimate.h"

namespace uncertainty_identification {

/// An estimate for people: nominal model with standard errors, mixture, noise variance, how the
/// estimation ended, rejected experiments with their reasons, warnings, candidates of automatic
/// choices and the fit on validation data, as far as there are any. Several lines, ending in a
/// newline.
std::string resultText(const Estimate& estimate);

}  // namespace uncertainty_identification
