#pragma once

#include "explanation/fit.h"

namespace uncertainty_identification {

/// Finds the largest peaks of the residual's spectrum and stores their frequencies in `summary`
/// (common_peak, own_peak). The fit of a hum (sens_hum) starts from them.
void findSpectralPeaks(const Residuals& residuals, const FitData& data, DataSummary* summary);

/// The signal minus its mean, multiplied by a Hann window.
Eigen::VectorXd windowed(Eigen::VectorXd signal);

}  // namespace uncertainty_identification
