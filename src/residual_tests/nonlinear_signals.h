#pragma once

#include <vector>

#include "uncertainty_identification/model/block.h"
#include "uncertainty_identification/model/nominal_model.h"

namespace uncertainty_identification {

/// What a plant that is not linear would add to the output, to first order: the plant's answers to
/// powers and the size of the input, and to powers, the size and the direction of motion of its own
/// output; and powers of the output as a curved sensor reads it. All are computed from the input
/// alone, by simulation from rest, and have passed through the inverse noise model D/C. One vector
/// of signals for each block, each signal with a mean square of 1 over all blocks.
std::vector<std::vector<Signals>> nonlinearSignals(const Polynomials& model,
                                                   const std::vector<Block>& blocks);

}  // namespace uncertainty_identification
