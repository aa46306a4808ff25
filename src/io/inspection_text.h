#pragma once

#include <string>

#include "inspection/inspected_data.h"

namespace uncertainty_identification {

/// What inspecting data found, as a text for people: what is in the files, the signals, which of
/// them could be input and output, and how the data are cut into experiments.
std::string inspectionText(const InspectedData& data);

/// One sentence each: input and output with their reasons, how they follow each other, and what
/// speaks for a closed loop. They serve the text, the configuration and the page.
std::vector<std::string> choiceSentences(const InspectedData& data);

/// The signals that were chosen without --config, in one line.
std::string chosenText(const InspectedData& data);

}  // namespace uncertainty_identification
