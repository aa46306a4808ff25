#pragma once

#include <string>

#include "inspection/survey.h"

namespace uncertainty_identification {

/// What a bag holds: every topic is a stream, every numeric field outside headers a channel; of
/// arrays the first elements, of arrays of more than 32 elements (images, scans, point clouds)
/// none. Topics of the ROS system itself (/rosout, /clock, /tf, /diagnostics) have no channels.
/// The stamps are those that identification takes: of headers, or else of recording. Throws
/// FileError when the file cannot be read, is not a bag or is damaged.
Survey surveyBag(const std::string& path);

}  // namespace uncertainty_identification
