#pragma once

#include <string>
#include <vector>

#include "inspection/signal_measures.h"
#include "uncertainty_identification/data/loaded_data.h"

namespace uncertainty_identification {

/// The files with their rows and stamps, and the topics of each bag, as tables.
std::string streamTables(const Survey& survey);

/// The signals that move, with what was measured, as a table; the constant ones in one line.
std::string signalTable(const Survey& survey, const std::vector<SignalMeasures>& measures);

/// The experiments with samples, sample time and duration.
std::string experimentTable(const LoadedData& data);

}  // namespace uncertainty_identification
