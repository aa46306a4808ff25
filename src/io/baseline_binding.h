#pragma once

#include "uncertainty_identification/baselines/baseline.h"

namespace uncertainty_identification {

class Archive;

/// A baseline as result.json holds it under "baseline".
void bind(Archive& archive, Baseline& baseline);

}  // namespace uncertainty_identification
