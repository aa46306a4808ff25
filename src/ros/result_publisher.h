#pragma once

#include <ros/node_handle.h>

#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "ros/message_conversions.h"
#include "ros/messages.h"
#include "session/identification_worker.h"

namespace uncertainty_identification {

/// Publishes results on the latched topics ~result, ~nominal_model and ~error_model; the latter two
/// are parts of the first and have its sequence number. All functions may be called from any
/// thread.
class ResultPublisher {
 public:
  explicit ResultPublisher(ros::NodeHandle private_node);

  /// Publishes a new result and returns the context that it was published with.
  ResultContext publish(const WorkerResult& result);

  /// Publishes a stored result of an earlier run with its stamp and number. The next result gets
  /// the number after it.
  void publishAgain(std::shared_ptr<const Estimate> estimate, const ResultContext& context);

  /// The message published last; no value before the first result and after forget().
  std::optional<messages::IdentificationResult> last() const;

  /// The estimate from which last() was made and its number; null and 0 if there is no last().
  std::pair<std::shared_ptr<const Estimate>, std::uint32_t> lastEstimate() const;

  /// The number of the last result; 0 if there is no last().
  std::uint32_t sequence() const;

  /// Forgets the last result and returns its number; 0 if there was none yet. Numbers go on rising.
  std::uint32_t forget();

 private:
  void publishLocked(std::shared_ptr<const Estimate> estimate, const ResultContext& context);

  ros::Publisher result_, nominal_model_, error_model_;
  mutable std::mutex mutex_;  // guards the members below
  std::uint32_t count_ = 0;
  std::optional<messages::IdentificationResult> last_;
  std::shared_ptr<const Estimate> last_estimate_;
};

}  // namespace uncertainty_identification
