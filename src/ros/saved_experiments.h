#pragma once

#include <optional>
#include <string>

#include "ros/identification_worker.h"
#include "ros/messages.h"

namespace uncertainty_identification {

/// Bags of experiments in one folder, saved/ in the store, whoever asks: a name in a request never
/// leads out of it.
class SavedExperiments {
 public:
  /// `store_directory` empty: requests are refused.
  SavedExperiments(const std::string& store_directory, const LimitOptions& limits,
                   IdentificationWorker& worker);

  /// Saves the worker's experiments, and `result` where there is one.
  messages::Save::Response save(const messages::Save::Request& request,
                                const std::optional<messages::IdentificationResult>& result) const;

  /// Gives the worker what it does not have yet, or does not have any more because it was rejected.
  messages::Load::Response load(const messages::Load::Request& request);

 private:
  std::string directory_;  // empty: none
  LimitOptions limits_;
  IdentificationWorker& worker_;
};

}  // namespace uncertainty_identification
