#include "ros/start_checks.h"

#include <ros/exceptions.h>

#include <filesystem>
#include <string>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

std::string resolved(const TopicResolver& resolve, const std::string& key,
                     const std::string& topic) {
  try {
    return resolve(topic);
  } catch (const ros::InvalidNameException& error) {
    throw ConfigurationError(key + ": found '" + topic +
                             "', which is no name of a topic: " + error.what());
  }
}

void requireFolder(const std::string& key, const std::string& folder) {
  std::error_code none;
  if (folder.empty() || std::filesystem::is_directory(folder, none)) return;
  throw ConfigurationError(key + ": found '" + folder +
                           "', which is no folder; create it, or leave the key out");
}

}  // namespace

void requireTopics(const Configuration& configuration, const TopicResolver& resolve) {
  const SignalOptions &input = configuration.input, &output = configuration.output;
  const std::string of_input = resolved(resolve, "input.topic", input.topic);
  const std::string of_output = resolved(resolve, "output.topic", output.topic);
  for (const SignalOptions& covariate : configuration.covariates)
    if (!covariate.topic.empty())
      resolved(resolve, "covariates: topic of '" + covariate.name + "'", covariate.topic);
  resolved(resolve, "experiment.topic", configuration.experiment.topic);
  if (configuration.experiment.mode == ExperimentMode::message) return;
  if (of_input == of_output && input.field == output.field)
    throw ConfigurationError("output.field: found '" + output.field + "' of topic '" + of_output +
                             "', which is the input as well; name another field or topic");
}

void requireFolders(const Configuration& configuration) {
  requireFolder("bag_directory", configuration.bag_directory);
  requireFolder("report_directory", configuration.report_directory);
}

}  // namespace uncertainty_identification
