#pragma once

#include <string>
#include <vector>

#include "ros/messages.h"
#include "uncertainty_identification/data/experiment.h"
#include "uncertainty_identification/data/loaded_data.h"

namespace uncertainty_identification {

/// Writes a bag with a message of type Experiment on the topic /experiment for each experiment and,
/// where given, the result they led to on /result. The file appears complete and on the disk, or
/// not at all. Throws FileError when it cannot be written, DataError when a start time does not fit
/// a ROS stamp.
void writeExperimentBag(const std::string& path, const std::vector<const Experiment*>& experiments,
                        const messages::IdentificationResult* result = nullptr);

/// The experiments of all messages of type Experiment in a bag. Throws FileError when it cannot be
/// read, is no bag or is damaged.
LoadedData readExperimentBag(const std::string& path);

}  // namespace uncertainty_identification
