#pragma once

#include "curves/window_fit.h"

namespace uncertainty_identification {

/// Of the squared residuals of a free simulation, the share that their own past does not predict
/// (an autoregression of order 10 over all windows): 1 for white noise of the sensor, little for
/// what a plant lacks, which acts through its slow dynamics. Noise that is coloured counts as
/// predictable. NaN where the windows are too short.
double unpredictableShare(const WindowFit& fit);

}  // namespace uncertainty_identification
