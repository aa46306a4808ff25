#pragma once

#include "explanation/fit.h"

namespace uncertainty_identification {

/// Area between the limits of |Go (1 + GDelta)| that hold 95 % of the plants of a fit at each
/// frequency, over the three decades below the Nyquist frequency [decades x decades]. Small: the
/// model says precisely what the next plant does. NaN where Go is not stable.
double bodeArea(const Fit& fit);

}  // namespace uncertainty_identification
