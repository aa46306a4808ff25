#pragma once

#include <ros/node_handle.h>

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "ros/messages.h"
#include "session/identification_worker.h"
#include "session/result_context.h"
#include "uncertainty_identification/io/result_json.h"

namespace uncertainty_identification {

/// A result with its overview in single numbers. `rejected` experiments are not used.
messages::Summary toMessage(const Result& result, const ResultContext& context, int rejected);

/// Computes the overview of results in a thread of its own and publishes it on the latched topic
/// ~summary, with the sequence number of the result. If results arrive faster than that, those in
/// between are passed over. All functions may be called from any thread.
class SummaryPublisher {
 public:
  /// Tells that something begins, in words; it ends when the returned object is destroyed.
  using Begins = std::function<std::shared_ptr<void>(const std::string&)>;

  /// Gets each result with its overview, once it is published.
  using Done = std::function<void(const Result&, const ResultContext&)>;

  /// Both are called in the publisher's thread.
  SummaryPublisher(ros::NodeHandle private_node, Begins begins, Done done);

  /// Blocks until the computation that is running has ended.
  ~SummaryPublisher();

  SummaryPublisher(const SummaryPublisher&) = delete;
  SummaryPublisher& operator=(const SummaryPublisher&) = delete;

  /// Asks for the summary of a result, and returns at once.
  void add(const WorkerResult& result, const ResultContext& context);

  /// The result with this sequence number and its overview, if it is the last one computed.
  std::optional<Result> resultOf(std::uint32_t sequence) const;

 private:
  struct Request {
    WorkerResult result;
    ResultContext context;
  };

  void run();
  void publish(const Request& request);

  const Begins begins_;
  const Done done_;
  ros::Publisher publisher_;
  mutable std::mutex mutex_;  // guards the members below
  std::condition_variable changed_;
  std::optional<Request> newest_;
  std::optional<Result> last_;
  std::uint32_t last_sequence_ = 0;
  bool stopping_ = false;
  std::thread thread_;  // declared last: it starts when all other members exist
};

}  // namespace uncertainty_identification
