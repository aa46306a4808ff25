#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/data/loaded_data.h"

namespace uncertainty_identification {

/// Writes experiments into one file. The file appears complete and on the disk, or not at all.
/// Throws FileError when it cannot be written, DataError when an experiment cannot be represented.
using WriteExperiments =
    std::function<void(const std::string& path, const std::vector<const Experiment*>&)>;

/// How experiments are kept in files. The ROS layer gives functions that use bags
/// (ros/experiment_bag.h).
struct ExperimentFiles {
  WriteExperiments write;

  /// Reads all experiments of a file. Throws FileError when it cannot be read or is damaged.
  std::function<LoadedData(const std::string& path)> read;

  /// The size [bytes] of a file's content after decompression, found without decompressing it.
  /// Throws FileError like `read`.
  std::function<std::uint64_t(const std::string& path)> unpacked_size;
};

}  // namespace uncertainty_identification
