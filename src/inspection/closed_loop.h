#pragma once

#include <optional>
#include <string>
#include <vector>

#include "inspection/following.h"
#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// How the signals of checked experiments follow each other, missing outputs left out.
Following followingOf(const std::vector<Experiment>& experiments);

/// If the input follows the output: one sentence that says how much, what that means for a model
/// and what to record instead. `input` and `output` name the signals. What it cannot see: a
/// controller that reacts to little noise only, and one whose excitation is much larger.
std::optional<std::string> closedLoopWarning(const Following& following, const std::string& input,
                                             const std::string& output);

}  // namespace uncertainty_identification
