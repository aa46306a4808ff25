#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/loaded_data.h"

namespace uncertainty_identification {

/// Called repeatedly while files are read. When it returns false, reading ends with CancelledError.
/// An empty function never cancels.
using KeepGoing = std::function<bool()>;

/// Reads experiments from a rosbag of any message types and compression. No roscore is needed.
///
/// The signals named by configuration.input, .output and .covariates are cut into experiments as
/// configuration.experiment states, and resampled. Stamps are those of the message headers;
/// messages without a header are stamped with the time of recording. Relative topic names belong to
/// the root namespace: actuator/command is /actuator/command. If the bag holds messages of type
/// Experiment and not the input topic, or in experiment.mode message, these messages are the
/// experiments; in that mode those of experiment.topic, if the bag has it.
///
/// Throws FileError when the file cannot be read, is not a bag, is damaged or was not closed;
/// ConfigurationError when a topic is not in the bag (the message lists those that are), a field is
/// not in the messages (the message lists those that are), or experiment.mode is service, as a bag
/// does not record calls of services. Broken messages and bad experiments are listed in the result.
LoadedData readBag(const std::string& path, const Configuration& configuration,
                   const KeepGoing& keep_going = {});

/// The size [bytes] of a bag after decompression, according to the headers of its chunks; nothing
/// is decompressed. Reading the bag fails if a chunk has another size than stated. Throws FileError
/// as above.
std::uint64_t unpackedSize(const std::string& path);

}  // namespace uncertainty_identification
