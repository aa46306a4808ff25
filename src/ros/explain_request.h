#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "ros/messages.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// The answer to a goal, and the explanation that the answer contains.
struct ExplainAnswer {
  messages::ExplainExperimentsResult result;
  std::optional<Explanation> explanation;  ///< present if the code is OK
};

/// Explains the bags that a goal names, or the experiments that `kept` returns if it names none.
/// Errors become the answer's code and message; nothing is thrown. `own` is the node's
/// configuration: it is used when the goal has no configuration, and bags are always read from its
/// bag_directory. `progress` is called while bags are read as well; when it returns false, the work
/// is cancelled. An explanation of `kept` has the number `sequence`, another one 0.
ExplainAnswer answerExplain(const messages::ExplainExperimentsGoal& goal, const Configuration& own,
                            const std::function<std::vector<Experiment>()>& kept,
                            std::uint32_t sequence, const ProgressCallback& progress);

}  // namespace uncertainty_identification
