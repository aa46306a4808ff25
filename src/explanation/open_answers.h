#pragma once

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/explanation/explanation.h"

/// Answers that the model which identify chooses by default is compared with.
namespace uncertainty_identification {

/// Whether orders and error model are left to be chosen.
bool leavesModelOpen(const Configuration& asked);

/// Whether nothing is wrong, but several experiments leave a rest that their differences may be; or
/// there is no answer, one of nothing but differences between experiments, or one that
/// explains only a part, where neither what the samples show alone nor a controller nor the noise
/// alone, which identify does not test, nor a curve that halves the error of the simulation may be
/// the reason.
bool isOpen(const Explanation& explanation);

}  // namespace uncertainty_identification
