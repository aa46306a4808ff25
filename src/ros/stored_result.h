#pragma once

#include <memory>
#include <string>

#include "ros/message_conversions.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/estimation/estimate.h"

namespace uncertainty_identification {

/// A result of a node, and what is needed to publish it again.
struct StoredResult {
  std::shared_ptr<const Estimate> estimate;
  ResultContext context;
  Configuration configuration;  ///< that was asked for; the estimate has it with its choices made
};

/// Writes result.json, with a section "publication", all of it or nothing. Throws FileError.
void saveStoredResult(const std::string& path, const StoredResult& result);

/// Reads it. Throws FileError when it cannot be read, ConfigurationError when it holds no such
/// result.
StoredResult loadStoredResult(const std::string& path);

}  // namespace uncertainty_identification
