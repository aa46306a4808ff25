#pragma once

#include "io/archive.h"
#include "uncertainty_identification/io/result_json.h"

namespace uncertainty_identification {

void bind(Archive& archive, PhysicalNumber& number);
void bind(Archive& archive, PhysicalNumbers& physical);
void bind(Archive& archive, SimulatedRun& run);
void bind(Archive& archive, Origin& origin);

}  // namespace uncertainty_identification
