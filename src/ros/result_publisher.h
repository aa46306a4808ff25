#pragma once

#include <ros/node_handle.h>

#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "ros/identification_worker.h"
#include "ros/message_conversions.h"
#include "ros/messages.h"

namespace uncertainty_identification {

/// Publishes results, latched: ~result, and its parts ~nominal_model and ~error_model with the same
/// sequence number. May be used from any thread.
class ResultPublisher {
 public:
  explicit ResultPublisher(ros::NodeHandle private_node);

  /// The context that the result was published with.
  ResultContext publish(const WorkerResult& result);

  /// Publishes a result of the time before as it was; the next one gets the number after it.
  void publishAgain(std::shared_ptr<const Estimate> estimate, const ResultContext& context);

  /// What was published last; nothing before the first result, or after forget().
  std::optional<messages::IdentificationResult> last() const;

  /// The estimate that last() was made from, null where that is nothing, and its number.
  std::pair<std::shared_ptr<const Estimate>, std::uint32_t> lastEstimate() const;

  /// Number of the last result, 0 where last() is nothing.
  std::uint32_t sequence() const;

  void forget();

 private:
  void publishLocked(std::shared_ptr<const Estimate> estimate, const ResultContext& context);

  ros::Publisher result_, nominal_model_, error_model_;
  mutable std::mutex mutex_;  // guards what follows
  std::uint32_t count_ = 0;
  std::optional<messages::IdentificationResult> last_;
  std::shared_ptr<const Estimate> last_estimate_;
};

}  // namespace uncertainty_identification
