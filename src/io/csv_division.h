#pragma once

#include <optional>

#include "io/csv_table.h"
#include "uncertainty_identification/data/loaded_data.h"

namespace uncertainty_identification {

/// How the rows of a table, whose stamps are about `period` [s] apart, are divided into
/// experiments: by experiment.mode duration or gap, by its markers, or else at pauses of the
/// logger, of which a warning tells. Nothing: they are one experiment.
std::optional<ExperimentOptions> divisionOf(const CsvTable& table, double period,
                                            const Configuration& configuration, LoadedData& data);

/// Divides the table like the signals of a bag (data/experiment_cutter.h), resamples the parts and
/// adds them as `<id>_000`, `<id>_001` and so on.
void addDivided(const CsvTable& table, const CsvFile& file, const ExperimentOptions& division,
                const Configuration& configuration, LoadedData& data);

}  // namespace uncertainty_identification
