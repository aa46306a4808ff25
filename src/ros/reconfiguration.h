#pragma once

#include <functional>
#include <mutex>
#include <optional>

#include "ros/experiment_store.h"
#include "ros/identification_worker.h"
#include "ros/messages.h"
#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {

/// The configuration that a node starts with: the last one of ~configure as long as the parameters
/// are those that the node had then, so that a node that was started again goes on as it was; the
/// parameters once they have changed.
Configuration configurationAtStart(const Configuration& parameters,
                                   const std::optional<StoredConfiguration>& stored);

/// The configuration that a node has, and what ~configure makes of it. May be used from any thread.
class Reconfiguration {
 public:
  /// `keep` is told each new configuration.
  Reconfiguration(const Configuration& parameters, const Configuration& current,
                  IdentificationWorker& worker,
                  std::function<void(const StoredConfiguration&)> keep);

  Configuration current() const;

  /// Answers a request: identifies from the experiments kept, which is cancelled when `keep_going`
  /// returns false, and goes on with the new configuration if that gives a usable model or there
  /// are no experiments yet.
  messages::Configure::Response answer(const messages::Configure::Request& request,
                                       const std::function<bool()>& keep_going);

 private:
  messages::Configure::Response configure(const Configuration& wanted,
                                          const std::function<bool()>& keep_going);

  const Configuration parameters_;
  IdentificationWorker& worker_;
  const std::function<void(const StoredConfiguration&)> keep_;
  mutable std::mutex mutex_;  // guards current_
  Configuration current_;
};

}  // namespace uncertainty_identification
