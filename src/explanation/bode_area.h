#pragma once

#include "explanation/fit.h"

namespace uncertainty_identification {

/// Area in the Bode magnitude diagram between the limits that contain |Go (1 + GDelta)| of 95 % of
/// the plants at each frequency, over the three decades below the Nyquist frequency [decades x
/// decades]. Go is the nominal model and GDelta the relative error, which is random. The smaller
/// the area, the more precisely the fit predicts the next plant. NaN where Go is not stable.
double bodeArea(const Fit& fit);

}  // namespace uncertainty_identification
