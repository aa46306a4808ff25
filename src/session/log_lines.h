#pragma once

#include <optional>
#include <string>
#include <vector>

#include "session/identification_worker.h"
#include "session/store_writer.h"

/// The lines of a node's log.
namespace uncertainty_identification {

/// An experiment was added to those kept.
std::string keptLine(const KeptExperiment& kept, const LimitOptions& limits);

/// A recording gave no experiment.
std::string rejectedLine(const RejectedExperiment& rejected);

/// There is a new result. `before` is the one that it replaces; null: none.
std::string resultLine(const WorkerResult& result, std::uint32_t sequence, const Estimate* before);

/// Files were in memory and could not be written when the node ended.
std::string unwrittenLine(const std::vector<std::string>& files);

/// Tells when a store begins to refuse, when it writes again, and when it first gives up a file.
class StoreLog {
 public:
  /// The line for the present state; none where nothing worth a line has changed.
  std::optional<std::string> line(const StoreStatus& now);

 private:
  bool failing_ = false, lost_ = false;
};

}  // namespace uncertainty_identification
