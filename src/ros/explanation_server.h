#pragma once

#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <ros/node_handle.h>

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "ros/action_thread.h"
#include "ros/messages.h"
#include "ros/service_thread.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {

/// Diagnostics of the last explanation. OK: nothing is wrong, or nothing was explained yet (null).
/// WARN: the simulation is wrong; the message names the causes.
void diagnoseExplanation(const Explanation* explanation,
                         diagnostic_updater::DiagnosticStatusWrapper& status);

/// The part of a node that explains. It serves the action ~explain_experiments and the service
/// ~explain, and explains automatically after a number of new experiments
/// (explanation.after_experiments). Each of these has a thread of its own. Explanations of the
/// node's own experiments are published on the latched topic ~explanation.
class ExplanationServer {
 public:
  /// Functions that return the node's present state. They are called from any thread.
  struct Source {
    std::function<Configuration()> configuration;
    std::function<std::vector<Experiment>()> experiments;
    std::function<std::uint32_t()> sequence;  ///< number of the last result
    /// An explanation begins, in words; it ends when the returned object is destroyed.
    std::function<std::shared_ptr<void>(const std::string&)> begins;
    /// The node's experiments were explained. Must not call the server.
    std::function<void(const Explanation&)> explained;
  };

  ExplanationServer(const ros::NodeHandle& private_node, Source source);

  ~ExplanationServer() { stop(); }

  ExplanationServer(const ExplanationServer&) = delete;
  ExplanationServer& operator=(const ExplanationServer&) = delete;

  /// Begins to answer requests.
  void start();

  /// Cancels the running explanations and blocks until they have ended. Afterwards the source is
  /// not called any more.
  void stop();

  /// To be called when the node has received an experiment, and when it has published a result. An
  /// automatic explanation starts with a result, when enough experiments are new. Both may be
  /// called from any thread; they return at once and do not call the source.
  void experimentAdded();
  void resultPublished();

  /// Forgets the last explanation, and cancels a running explanation of the node's experiments.
  void reset();

  /// Number of requests and goals that wait until another one has ended. Not to be called after
  /// stop().
  int waiting() const { return service_thread_.waiting() + action_->waiting(); }

  /// The last explanation of the node's experiments; null before the first one and after reset().
  std::shared_ptr<const Explanation> last() const;

 private:
  using Goal = messages::ExplainExperimentsGoal;
  using Response = messages::ExplainExperimentsResult;

  Response explain(const Goal& goal, const ProgressCallback& progress);
  void publish(const Response& response, Explanation explanation, unsigned resets);
  void run();
  bool waitForResult(std::uint64_t* results);
  bool isDue(int after_experiments);

  const Source source_;
  ros::Publisher publisher_;
  std::atomic<bool> stopping_{false};
  std::atomic<unsigned> resets_{0};
  mutable std::mutex mutex_;  // guards the members down to last_
  std::condition_variable changed_;
  std::uint64_t results_ = 0;  // number of results published
  int unexplained_ = 0;        // number of experiments since the last automatic explanation
  std::shared_ptr<const Explanation> last_;
  ServiceThread service_thread_;
  ros::ServiceServer service_;
  std::unique_ptr<ActionThread<messages::ExplainExperimentsAction>> action_;
  std::thread thread_;  // declared last: it starts when all other members exist
};

}  // namespace uncertainty_identification
