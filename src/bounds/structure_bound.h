#pragma once

#include <Eigen/Core>

#include "uncertainty_identification/bounds/uncertainty_bounds.h"
#include "uncertainty_identification/estimation/estimate.h"

namespace uncertainty_identification {

/// |G/Go - 1| that a share `level` of complex Gaussian errors of this standard error does not
/// exceed, at `omega` [rad/s]: sqrt(-ln(1 - level)) times the standard error, interpolated on
/// logarithmic axes and constant beyond its ends. At most 10, which says as much as infinity. Zeros
/// where no structure error is known.
Eigen::VectorXd structureBound(const StructureError& error, const Eigen::VectorXd& omega,
                               double level);

/// Moves the limits away from `center` by an independent error of the size `by`.
void widen(double center, double by, double* lower, double* upper);

/// The bands with estimation errors, widened by the structure's: each distance of a limit from Go
/// and the bound are added as independent errors. Where the bound reaches 1, |G| may vanish and its
/// phase is not known; hidden_from says from where on.
void addStructureError(const StructureError& error, FrequencyBounds* bounds);

}  // namespace uncertainty_identification
