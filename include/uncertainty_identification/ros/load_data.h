#pragma once

#include <string>
#include <vector>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/loaded_data.h"
#include "uncertainty_identification/ros/bag_reader.h"

namespace uncertainty_identification {

/// The files that the paths stand for, in order: a file itself; for a folder the .csv, .tsv and
/// .bag files directly in it, sorted by name. Throws FileError when a path is neither, or a folder
/// has no such files.
std::vector<std::string> dataFiles(const std::vector<std::string>& paths);

/// Reads the experiments of all paths, in order. A path is a .bag file (bag_reader.h), a .csv file
/// (csv.h), or a folder, which stands for the .csv and .bag files directly in it, sorted by name.
/// If several files use the same id, the name of the file is put before it: "run2/experiment_000".
/// Throws FileError when a path is none of these or a folder has no such files, DataError when
/// there is no usable experiment (the message gives the reasons), and what the readers throw.
LoadedData loadData(const std::vector<std::string>& paths, const Configuration& configuration,
                    const KeepGoing& keep_going = {});

}  // namespace uncertainty_identification
