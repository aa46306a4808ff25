#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "session/experiment_store.h"
#include "session/identification_worker.h"
#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

/// The configuration that a node starts with: the last one set by ~configure if the node's
/// parameters are still those of that time, so that a restarted node continues as before; otherwise
/// the parameters.
Configuration configurationAtStart(const Configuration& parameters,
                                   const std::optional<StoredConfiguration>& stored);

/// Holds a node's configuration and changes it on request. May be used from any thread.
class Reconfiguration {
 public:
  /// `keep` is called with each new configuration.
  Reconfiguration(const Configuration& parameters, const Configuration& current,
                  IdentificationWorker& worker,
                  std::function<void(const StoredConfiguration&)> keep);

  Configuration current() const;

  struct Outcome {
    bool adopted = false;  ///< false: no usable model was found; the old configuration stays
    std::string message;   ///< how the identification ended
  };

  /// Identifies from the worker's experiments with the configuration that the YAML text `yaml`
  /// gives, and adopts that configuration if there is a usable model or there are no experiments.
  /// The identification is cancelled when `keep_going` returns false; a model that was not found
  /// within limits.max_request_time is not adopted.
  ///
  /// What a running node cannot change (topics, folders) stays as it is when the text leaves it
  /// out, and so do limits. Throws RefusedError when the text changes such a key or raises a limit
  /// above that of the node's parameters; ConfigurationError when it is not a configuration;
  /// DataError when the experiments do not support it.
  Outcome configure(const std::string& yaml, const std::function<bool()>& keep_going);

 private:
  const Configuration parameters_;
  IdentificationWorker& worker_;
  const std::function<void(const StoredConfiguration&)> keep_;
  mutable std::mutex mutex_;  // guards current_
  Configuration current_;
};

}  // namespace uncertainty_identification
