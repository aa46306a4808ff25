#pragma once

#include <string>
#include <vector>

#include "inspection/inspected_data.h"

namespace uncertainty_identification {

/// What the files and folders hold (as loadData finds them). A file that cannot be read is a remark
/// while others can. Throws FileError when none can be read, or a path leads to none.
Survey surveyData(const std::vector<std::string>& paths, const Configuration& configuration);

/// Surveys and measures the data, chooses input and output and reads the experiments. `given`:
/// whether the configuration's input and output are to be taken; otherwise they are chosen. Throws
/// what surveyData throws, and ConfigurationError for an input or output that the data do not hold.
InspectedData inspectData(const std::vector<std::string>& paths, const Configuration& configuration,
                          bool given);

}  // namespace uncertainty_identification
