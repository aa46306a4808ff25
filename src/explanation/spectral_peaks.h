#pragma once

#include "explanation/fit.h"

namespace uncertainty_identification {

/// Largest peaks of the residual's spectrum, where a hum would start, to `summary`.
void findSpectralPeaks(const Residuals& residuals, const FitData& data, DataSummary* summary);

}  // namespace uncertainty_identification
