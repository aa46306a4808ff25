#pragma once

#include <string>
#include <vector>

#include "ros/messages.h"
#include "session/experiment_files.h"

namespace uncertainty_identification {

/// Writes a bag with one message of type Experiment on the topic /experiment for each experiment
/// and, if `result` is not null, the result that they led to on the topic /result. The file appears
/// complete and on the disk, or not at all. Throws FileError when it cannot be written, DataError
/// when a start time does not fit a ROS stamp.
void writeExperimentBag(const std::string& path, const std::vector<const Experiment*>& experiments,
                        const messages::IdentificationResult* result = nullptr);

/// Reads the experiments of all messages of type Experiment in a bag. Throws FileError when the
/// file cannot be read, is not a bag or is damaged.
LoadedData readExperimentBag(const std::string& path);

/// Bags as the files in which a node keeps its experiments.
ExperimentFiles experimentBags();

}  // namespace uncertainty_identification
