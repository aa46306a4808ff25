#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "ros/messages.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// The answer to a goal, and the explanation that it holds.
struct ExplainAnswer {
  messages::ExplainExperimentsResult result;
  std::optional<Explanation> explanation;  ///< where the code is OK
};

/// Explains the bags of a goal, or what `kept` gives where it names none, and tells errors by code
/// and message instead of throwing. `own` is the node's configuration: its bag_directory counts,
/// and all of it where the goal has none. `progress` is called while bags are read too; false from
/// it cancels. The result's explanation carries `sequence` where it is of `kept`.
ExplainAnswer answerExplain(const messages::ExplainExperimentsGoal& goal, const Configuration& own,
                            const std::function<std::vector<Experiment>()>& kept,
                            std::uint32_t sequence, const ProgressCallback& progress);

}  // namespace uncertainty_identification
