#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/loaded_data.h"

namespace uncertainty_identification {

/// Asked again and again while files are read; false ends the reading by CancelledError. Empty: go
/// on.
using KeepGoing = std::function<bool()>;

/// Reads experiments from a rosbag, whatever its message types and compression; no roscore is
/// needed.
///
/// The signals are those of configuration.input, .output and .covariates, cut as
/// configuration.experiment says and resampled. Stamps come from the header where a signal's
/// messages have one, else from the time of recording. Relative topic names mean the root
/// namespace: actuator/command is /actuator/command. Where the bag holds messages of type
/// Experiment and no input topic, or in experiment.mode message, they are the experiments as they
/// are.
///
/// Throws FileError when the file cannot be read, is no bag, is damaged or was not closed;
/// ConfigurationError when a topic is not in the bag (the message lists those that are), a field is
/// not in the messages (lists those that are), or the mode needs what a bag cannot tell. Broken
/// messages and bad experiments are listed in the result.
LoadedData readBag(const std::string& path, const Configuration& configuration,
                   const KeepGoing& keep_going = {});

/// [bytes] that the chunks of a bag unpack to, as their headers say; none is unpacked. Reading
/// holds every chunk to it. Throws FileError as above.
std::uint64_t unpackedSize(const std::string& path);

}  // namespace uncertainty_identification
