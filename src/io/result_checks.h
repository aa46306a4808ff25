#pragma once

#include "uncertainty_identification/bounds/bounds.h"
#include "uncertainty_identification/estimation/estimate.h"
#include "uncertainty_identification/explanation/explanation.h"

/// Checks of results that were read from a file or a message: whether their parts fit together, so
/// that whoever uses them may rely on sizes and on the numbers' range. All throw ConfigurationError
/// that names the key.
namespace uncertainty_identification {

/// Sizes, finite coefficients, a mixture that is one, covariances that are symmetric and positive
/// semidefinite. An estimate without coefficients of B holds no model; only its error model is
/// checked then.
void requireConsistent(const Estimate& estimate);

/// Whether C and D of the noise model H = C/D have their roots inside the unit circle. The mean of
/// separate fits (Baseline) need not.
void requireStableNoise(const NominalModelEstimate& model);

/// Limits for every level and at every point of their grid, a fold for every score.
void requireConsistent(const Bounds& bounds);

/// As many values as arguments in every curve and picture.
void requireConsistent(const Explanation& explanation);

}  // namespace uncertainty_identification
