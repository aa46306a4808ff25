#pragma once

#include <string>
#include <vector>

#include "uncertainty_identification/data/experiment.h"

namespace uncertainty_identification {

/// Writes experiments like a recording of a rig. readBag() with the default configuration gives
/// them back. The topics are: Sample on /actuator/command and /sensor/measurement (outputs that
/// were not measured are NaN) and on /covariate/<name>, ExperimentMarker on /experiment/active. The
/// file appears complete or not at all. Throws FileError when it cannot be written, DataError when
/// experiments overlap in time, are not in order of their start, or lie outside the range of ROS
/// stamps.
void writeBag(const std::string& path, const std::vector<Experiment>& experiments);

}  // namespace uncertainty_identification
