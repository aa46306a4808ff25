#pragma once

#include <string>
#include <vector>

#include "inspection/inspected_data.h"

namespace uncertainty_identification {

/// What the files and folders hold (as loadData finds them). A file that cannot be read is a remark
/// while others can. Throws FileError when none can be read, or a path leads to none.
Survey surveyData(const std::vector<std::string>& paths, const Configuration& configuration);

/// Whether files of columns alone were given, whose names leave no doubt to readCsv.
bool readsByItself(const std::vector<std::string>& paths);

/// Surveys and measures the data, chooses input and output and reads the experiments. `given`:
/// whether the configuration's input and output are to be taken; otherwise they are chosen. Throws
/// what surveyData throws; why no experiments can be read is `failure` of the result.
InspectedData inspectData(const std::vector<std::string>& paths, const Configuration& configuration,
                          bool given);

/// The configuration with which data are read where none is given: every default, and input and
/// output by their names. `told`: what was chosen, in one line; empty where nothing had to be
/// chosen. Throws ConfigurationError where the names leave a doubt, and what inspectData throws.
Configuration configurationByNames(const std::vector<std::string>& paths, std::string& told);

}  // namespace uncertainty_identification
