#pragma once

#include <string>
#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/loaded_data.h"
#include "uncertainty_identification/ros/bag_reader.h"

namespace uncertainty_identification {

/// Reads all experiments of the paths, in order: a .bag (bag_reader.h), a .csv (csv.h), or a
/// folder: the .csv and .bag files directly in it, sorted by name. An id that several files use
/// gets the file's name in front, "run2/experiment_000". Throws FileError for a path that is none
/// of these or a folder without such files, DataError when no experiment is left (the message gives
/// the reasons), and what the readers throw.
LoadedData loadData(const std::vector<std::string>& paths, const Configuration& configuration,
                    const KeepGoing& keep_going = {});

}  // namespace uncertainty_identification
