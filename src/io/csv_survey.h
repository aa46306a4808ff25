#pragma once

#include <string>

#include "inspection/survey.h"
#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

/// What a file of columns holds: each column of numbers is a channel, whatever its name. The time
/// and the experiments are those of the configuration, or else of well-known names. Without a
/// column of time the rows are counted; of several the first is taken; `remarks` tell. Throws
/// FileError for a file that cannot be read, or without a column of numbers; ConfigurationError for
/// a configured column that it does not have.
Survey surveyCsv(const std::string& path, const Configuration& configuration);

}  // namespace uncertainty_identification
