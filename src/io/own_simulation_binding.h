#pragma once

#include "io/archive.h"
#include "uncertainty_identification/own_simulation/findings.h"
#include "uncertainty_identification/own_simulation_options.h"

namespace uncertainty_identification {

void bind(Archive& archive, OwnSimulationOptions& options);
void bind(Archive& archive, OwnValue& value);
void bind(Archive& archive, OwnExtension& extension);
void bind(Archive& archive, OwnSimulationFindings& findings);
void bind(Archive& archive, SimulationCauses& simulation);

}  // namespace uncertainty_identification
