#pragma once

#include <vector>

#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/estimation/estimate.h"

namespace uncertainty_identification {

/// How well the data determine the plant at each frequency without the structure that was chosen
/// from them (StructureError): the standard error of a response that is estimated by itself in the
/// octave about the frequency,
///
///     |error/Go|^2 = N Phi_v / (|Go|^2 sum |U|^2),   Phi_v = |C/D|^2 noise variance,
///
/// where the sum is over the octave's independent frequencies of all experiments [Ljung 1999,
/// (6.44)]. Inputs and noise are differenced, so that steps and the ends of records do not leak.
/// From the longest record's lowest frequency to the Nyquist frequency. `estimate` needs its
/// nominal model and noise variance.
StructureError structureErrorOf(const std::vector<Experiment>& experiments,
                                const Estimate& estimate);

}  // namespace uncertainty_identification
