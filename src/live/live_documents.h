#pragma once

#include <string>
#include <vector>

#include "session/node_status.h"
#include "session/result_context.h"
#include "uncertainty_identification/explanation/explanation.h"
#include "uncertainty_identification/identifier.h"
#include "uncertainty_identification/io/result_json.h"

/// The parts of the live page as JSON in one line, as report/live.js reads them.
namespace uncertainty_identification {

/// What a node is doing now.
struct LiveStatus {
  NodeStatus node;
  RecorderStatus recorder;
  double now = 0;  ///< [s] by the clock of the activities
};

/// `progress`, of the running identification, may be null.
std::string liveStatus(const LiveStatus& status, const Progress* progress);

/// The newest experiments first, up to a hundred; those that were rejected before they became
/// experiments apart; and how many there are in all.
std::string liveExperiments(const std::vector<ExperimentDigest>& experiments);

/// What the first page of a report reads of a result.
std::string liveResult(const Result& result, const ResultContext& context);

/// The verdict, the causes and the tests of an explanation.
std::string liveExplanation(const Explanation& explanation);

}  // namespace uncertainty_identification
