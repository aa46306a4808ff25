#pragma once

// All headers that the generated headers include come first, so that the macro below affects only
// the generated headers.
#include <actionlib_msgs/GoalID.h>
#include <actionlib_msgs/GoalStatus.h>
#include <ros/message_operations.h>
#include <ros/service_traits.h>
#include <ros/types.h>
#include <std_msgs/Header.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

// The generated code is in the namespace uncertainty_identification, in which the core has its own
// Experiment and NominalModel. All code therefore includes the messages through this header, which
// renames their namespace to uncertainty_identification_messages and makes them available as
// uncertainty_identification::messages.
#define uncertainty_identification uncertainty_identification_messages
#include <uncertainty_identification/Cause.h>
#include <uncertainty_identification/CauseParameter.h>
#include <uncertainty_identification/Check.h>
#include <uncertainty_identification/Configure.h>
#include <uncertainty_identification/Covariate.h>
#include <uncertainty_identification/ErrorModel.h>
#include <uncertainty_identification/Experiment.h>
#include <uncertainty_identification/ExperimentMarker.h>
#include <uncertainty_identification/ExperimentSummary.h>
#include <uncertainty_identification/Explain.h>
#include <uncertainty_identification/ExplainExperimentsAction.h>
#include <uncertainty_identification/Explanation.h>
#include <uncertainty_identification/FaultStatus.h>
#include <uncertainty_identification/GaussianComponent.h>
#include <uncertainty_identification/GetResult.h>
#include <uncertainty_identification/IdentificationResult.h>
#include <uncertainty_identification/IdentificationStatus.h>
#include <uncertainty_identification/Identify.h>
#include <uncertainty_identification/IdentifyBagsAction.h>
#include <uncertainty_identification/ListExperiments.h>
#include <uncertainty_identification/Load.h>
#include <uncertainty_identification/NominalModel.h>
#include <uncertainty_identification/Parameter.h>
#include <uncertainty_identification/RejectExperiment.h>
#include <uncertainty_identification/RobustMargin.h>
#include <uncertainty_identification/Sample.h>
#include <uncertainty_identification/SampleModels.h>
#include <uncertainty_identification/Save.h>
#include <uncertainty_identification/SignalTiming.h>
#include <uncertainty_identification/TriedEffect.h>
#include <uncertainty_identification/UncertaintyBounds.h>
#include <uncertainty_identification/WriteReport.h>
#undef uncertainty_identification

#include "ros/goal_serializer.h"

namespace uncertainty_identification {
namespace messages = ::uncertainty_identification_messages;
}
