#pragma once

#include <string>
#include <vector>

#include "ros/messages.h"
#include "session/experiment_files.h"

namespace uncertainty_identification {

/// The topic of the last message of such a bag, a std_msgs/UInt32: the sum, modulo 2^32, of the
/// CRC-32 checksums of all other messages.
constexpr const char* kChecksumTopic = "/experiment_checksum";

/// Writes a bag with one message of type Experiment on the topic /experiment for each experiment,
/// if `result` is not null the result that they led to on the topic /result, and a checksum. The
/// file appears complete and on the disk, or not at all. Throws FileError when it cannot be
/// written, DataError when a start time does not fit a ROS stamp.
void writeExperimentBag(const std::string& path, const std::vector<const Experiment*>& experiments,
                        const messages::IdentificationResult* result = nullptr);

/// Reads the experiments of all messages of type Experiment in a bag. Throws FileError when the
/// file cannot be read, is not a bag, is damaged or does not match its checksum, if it has one.
LoadedData readExperimentBag(const std::string& path);

/// Bags as the files in which a node keeps its experiments.
ExperimentFiles experimentBags();

}  // namespace uncertainty_identification
