#pragma once

#include <vector>

#include "explanation/fit.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// How residuals are distributed, as far as that is known.
enum class ResidualLaw {
  gaussian,
  heavy_tails,  ///< accepted as a cause, with or without readings that are wrong
  of_steps      ///< most of the noise is rounding to the sensor's steps
};

/// Tests of the residuals of a fit: whiteness; dependence on the input and on nonlinear features of
/// it; variance over time; correlation of the squares (volatility); kurtosis (tails) and symmetry
/// of the distribution; variance over the experiments. Of residuals that are not Gaussian the first
/// three are done, as the others would see the same again, and of heavy tails volatility as well:
/// single large values do not follow each other.
std::vector<Check> checkResiduals(const Fit& fit, const FitData& data, ResidualLaw law);

/// p-value below which a check fails. It is this small because a data set shows many things that no
/// model describes, and because several tests are done on each of many data sets.
constexpr double kCheckThreshold = 1e-6;

bool allPassed(const std::vector<Check>& checks);

}  // namespace uncertainty_identification
