#pragma once

#include <vector>

#include "uncertainty_identification/estimation/estimate.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// Whether a line in the spectrum is among the causes, and the model without them has it as well:
/// as poles of plant or noise of this frequency, whose oscillation hardly decays within `samples`
/// samples, an experiment's length. That the model passes its tests is then no reason against the
/// cause: an oscillation that nothing damps comes from outside.
bool hasLineAsPoles(const std::vector<Cause>& causes, const NominalModelEstimate& without,
                    double samples);

/// Whether poles of plant or noise have this frequency [rad/sample], and lose less than a share of
/// their oscillation within `samples`.
bool hasUndampedPoles(const NominalModelEstimate& model, double frequency, double samples,
                      double share);

/// Frequency [rad/sample] of an oscillation of plant or noise by more than three periods in an
/// experiment of so many samples, which loses less than a tenth there; 0: there is none.
double undampedFrequency(const NominalModelEstimate& model, double samples);

/// Whether the plant oscillates, by more than ten periods in an experiment of so many samples, and
/// loses less than a tenth of it there. No machine does: it is hum, or another line of the noise,
/// whatever its tests say.
bool neverDecays(const NominalModelEstimate& plant, double samples);

/// Whether the model without causes only stands for a line in the spectrum: one that is all that
/// the explanation names beside differences, or one that never decays and that it does not name.
bool standsForALine(const Explanation& explanation, const NominalModelEstimate& without,
                    double samples);

}  // namespace uncertainty_identification
