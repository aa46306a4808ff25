#pragma once

#include <ros/node_handle.h>

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "ros/bounds_message.h"
#include "uncertainty_identification/io/result_json.h"

namespace uncertainty_identification {

/// Computes the bounds of results in a thread of its own, so that they delay nothing, and publishes
/// them, latched: ~uncertainty_bounds, with the result's sequence number. Of results that come
/// quicker than bounds can be computed only the newest gets some. May be used from any thread.
/// `done` is told the result with its bounds, in that thread.
class BoundsPublisher {
 public:
  using Done = std::function<void(const Result&)>;

  BoundsPublisher(ros::NodeHandle private_node, Done done);

  /// Waits for the bounds being computed.
  ~BoundsPublisher();

  BoundsPublisher(const BoundsPublisher&) = delete;
  BoundsPublisher& operator=(const BoundsPublisher&) = delete;

  /// Computes nothing where the estimate's configuration asks for no frequencies.
  void add(std::shared_ptr<const Estimate> estimate, const ResultContext& context);

  /// The bounds of result `sequence`, if they are the last ones computed.
  std::optional<Bounds> boundsOf(std::uint32_t sequence) const;

 private:
  struct Request {
    std::shared_ptr<const Estimate> estimate;
    ResultContext context;
  };

  void run();
  void publish(const Request& request);

  const Done done_;
  ros::Publisher publisher_;
  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::optional<Request> newest_;
  std::optional<Bounds> last_;
  std::uint32_t last_sequence_ = 0;
  bool stopping_ = false;
  std::thread thread_;  // last, so that it finds all of the above
};

}  // namespace uncertainty_identification
