#pragma once

#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// Adds to each cause what explains the data as well and the likelihood does not fit itself: the
/// other places of a curve that the free simulation found there, too; and a curve of the plant
/// where one of the input and one of the sensor cannot be told apart, since it lies between them.
/// The message names them as well.
void tellEquivalentCurves(Explanation* explanation);

}  // namespace uncertainty_identification
