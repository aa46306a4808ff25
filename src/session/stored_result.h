#pragma once

#include <memory>
#include <string>

#include "session/result_context.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/estimation/estimate.h"

namespace uncertainty_identification {

/// A result of a node with all that is needed to publish it again after a restart.
struct StoredResult {
  std::shared_ptr<const Estimate> estimate;
  ResultContext context;
  /// As it was asked for. In the estimate's copy the automatic choices are replaced by what was
  /// chosen.
  Configuration configuration;
};

/// Writes result.json as the tool `identify` does, with an additional section "publication". The
/// file appears complete or not at all. Throws FileError.
void saveStoredResult(const std::string& path, const StoredResult& result);

/// Reads such a file. Throws FileError when it cannot be read, ConfigurationError when it does not
/// hold a result of a node.
StoredResult loadStoredResult(const std::string& path);

}  // namespace uncertainty_identification
