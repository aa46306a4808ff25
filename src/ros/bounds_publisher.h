#pragma once

#include <ros/node_handle.h>

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "ros/bounds_message.h"
#include "uncertainty_identification/io/result_json.h"

namespace uncertainty_identification {

/// Computes the bounds of results in a thread of its own and publishes them on the latched topic
/// ~uncertainty_bounds, with the sequence number of the result. If results arrive faster than
/// bounds can be computed, bounds are computed only for the newest result. All functions may be
/// called from any thread.
class BoundsPublisher {
 public:
  using Done = std::function<void(const Result&, const ResultContext&)>;

  /// Tells that something begins, in words; it ends when the returned object is destroyed.
  using Begins = std::function<std::shared_ptr<void>(const std::string&)>;

  /// Both are called in the publisher's thread: `begins` before each computation, `done` with each
  /// result and its bounds.
  BoundsPublisher(ros::NodeHandle private_node, Begins begins, Done done);

  /// Ends the computation that is running, whose bounds are not published.
  ~BoundsPublisher();

  BoundsPublisher(const BoundsPublisher&) = delete;
  BoundsPublisher& operator=(const BoundsPublisher&) = delete;

  /// Asks for the bounds of a result, which has none yet. Does nothing if its configuration has
  /// bounds.frequencies 0.
  void add(const Result& result, const ResultContext& context);

  /// The result with this sequence number and its bounds, if they are the last ones computed.
  std::optional<Result> resultOf(std::uint32_t sequence) const;

 private:
  struct Request {
    Result result;
    ResultContext context;
  };

  void run();
  void publish(Request request);

  const Begins begins_;
  const Done done_;
  ros::Publisher publisher_;
  mutable std::mutex mutex_;  // guards the members below
  std::condition_variable changed_;
  std::optional<Request> newest_;
  std::optional<Result> last_;
  std::uint32_t last_sequence_ = 0;
  std::atomic<bool> stopping_{false};
  std::thread thread_;  // declared last: it starts when all other members exist
};

}  // namespace uncertainty_identification
