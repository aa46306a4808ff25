#pragma once

#include <optional>
#include <string>
#include <vector>

#include "explanation/last_thirds.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// The names of the curves that the simulation shows and of those tied with them, where they take
/// away at least half of the squared error of simulating held-out data; otherwise nothing.
std::vector<std::string> leadingCurves(const SimulationCauses& simulation);

/// Joins what the likelihood found with what explanation->simulation shows. The likelihood's causes
/// stand where all tests of the residuals pass with them and the simulation gains about as much by
/// them, or little by the curves. Otherwise the curves are the causes: effects of noise, samples
/// and experiments that were found beside a curve that the likelihood's model cannot contain may
/// only be its symptoms. Where tests pass though the simulation fits by less than 50 %, a warning
/// says so. Of records of which none is held out, `last_thirds` may confirm a curve that the free
/// simulation does not find.
void joinSimulation(Explanation* explanation, const std::optional<LastThirds>& last_thirds);

}  // namespace uncertainty_identification
