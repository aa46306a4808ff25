#pragma once

#include <optional>
#include <string>

#include "curves/curve_model.h"
#include "curves/simulation_data.h"

namespace uncertainty_identification {

/// How a record that was not fitted to differs from those that were, as far as one number of the
/// linear plant can tell.
struct RecordDifference {
  enum class In { offset, delay, gain };

  int record = 0;
  In in = In::offset;
  double value = 0;  ///< offset of y [units of y]; delay [s]; factor of the gain
  double fit_before = 0, fit_after = 0;  ///< [%] of the record, without the difference and with it
};

/// The difference that takes away at least three quarters of the squared error of simulating a
/// held-out record, of the record that is simulated worst; absent where no single one does. An
/// offset is told as the shift of the output once it has settled; a gain comes with one: elsewhere
/// on a curved characteristic both are others.
std::optional<RecordDifference> differenceOf(const SimulationData& held, const CurveModel& linear);

/// The difference in a sentence, for the experiment of this name.
std::string inWords(const RecordDifference& difference, const std::string& experiment);

}  // namespace uncertainty_identification
