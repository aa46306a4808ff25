#pragma once

#include "ros/topic_router.h"
#include "uncertainty_identification/configuration.h"

/// What a node checks before it starts, because a running node could only wait for it in vain.
namespace uncertainty_identification {

/// Throws ConfigurationError, with the key, when the name of a topic is not valid, or when input
/// and output are the same field of the same topic. `resolve` throws ros::InvalidNameException.
void requireTopics(const Configuration& configuration, const TopicResolver& resolve);

/// Throws ConfigurationError, with the key, when bag_directory or report_directory is no folder.
void requireFolders(const Configuration& configuration);

}  // namespace uncertainty_identification
