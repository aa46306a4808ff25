#pragma once

#include "ros/generated_prelude.h"

// The generated code lives in the namespace uncertainty_identification, where the core has its own
// Experiment and NominalModel. It is included through these headers only, under a macro, and so is
// found in uncertainty_identification::messages.
#define uncertainty_identification uncertainty_identification_messages
#include <uncertainty_identification/ErrorModel.h>
#include <uncertainty_identification/Experiment.h>
#include <uncertainty_identification/ExperimentMarker.h>
#include <uncertainty_identification/Explanation.h>
#include <uncertainty_identification/FaultStatus.h>
#include <uncertainty_identification/IdentificationResult.h>
#include <uncertainty_identification/IdentificationStatus.h>
#include <uncertainty_identification/NominalModel.h>
#include <uncertainty_identification/RobustMargin.h>
#include <uncertainty_identification/Sample.h>
#include <uncertainty_identification/SimulationError.h>
#include <uncertainty_identification/Summary.h>
#include <uncertainty_identification/UncertaintyBounds.h>
#undef uncertainty_identification

namespace uncertainty_identification {
namespace messages = ::uncertainty_identification_messages;
}
