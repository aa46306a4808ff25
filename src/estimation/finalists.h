#pragma once

#include <vector>

#include "estimation/optimisation.h"

namespace uncertainty_identification {

/// A point that competes with others for the highest likelihood.
struct Finalist {
  ModelParameters point;
  double log_likelihood = 0;
};

/// Climbs from all points in turns of a few scoring steps, only as far as it takes to tell their
/// optima apart: a point leaves when it meets a higher one, or when it is far below the highest and
/// no longer gains on it. Returns those that are left, highest first. Points whose likelihood is
/// not finite leave as well. options.floor is replaced by the one that goes with each point.
std::vector<Finalist> climbTogether(const Likelihood& likelihood,
                                    const std::vector<Finalist>& points,
                                    const OptimisationOptions& options, int rounds);

}  // namespace uncertainty_identification
