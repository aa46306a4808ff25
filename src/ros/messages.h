#pragma once

#include "ros/topic_messages.h"

// Services and actions, as topic_messages.h explains.
#define uncertainty_identification uncertainty_identification_messages
#include <uncertainty_identification/Configure.h>
#include <uncertainty_identification/Explain.h>
#include <uncertainty_identification/ExplainExperimentsAction.h>
#include <uncertainty_identification/GetResult.h>
#include <uncertainty_identification/Identify.h>
#include <uncertainty_identification/IdentifyBagsAction.h>
#include <uncertainty_identification/ListExperiments.h>
#include <uncertainty_identification/Load.h>
#include <uncertainty_identification/RejectExperiment.h>
#include <uncertainty_identification/SampleModels.h>
#include <uncertainty_identification/Save.h>
#include <uncertainty_identification/WriteReport.h>
#undef uncertainty_identification

#include "ros/goal_serializer.h"
