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

/// What the last explanation says of the simulation. OK: nothing is wrong, or nothing was explained
/// yet (null); WARN: something is, with the causes' names.
void diagnoseExplanation(const Explanation* explanation,
                         diagnostic_updater::DiagnosticStatusWrapper& status);

/// The part of a node that explains: the action ~explain_experiments, the service ~explain, and an
/// explanation of its own accord after each so many experiments, each in a thread of its own.
/// Explanations of the node's experiments are published, latched: ~explanation.
class ExplanationServer {
 public:
  /// What the node has at the moment; called from any thread.
  struct Source {
    std::function<Configuration()> configuration;
    std::function<std::vector<Experiment>()> experiments;
    std::function<std::uint32_t()> sequence;  ///< of the last result
  };

  ExplanationServer(const ros::NodeHandle& private_node, Source source);

  ~ExplanationServer() { stop(); }

  ExplanationServer(const ExplanationServer&) = delete;
  ExplanationServer& operator=(const ExplanationServer&) = delete;

  /// Answers requests from now on.
  void start();

  /// Cancels what runs and waits for its end; the source is not called any more.
  void stop();

  /// Tell that the node has one more experiment, and that it has a result of its experiments: then
  /// the explanation of its own accord may be due. May be called from any thread, and call nothing
  /// of the source in it.
  void experimentCame();
  void resultCame();

  /// Forgets the last explanation; one of the node's experiments that runs is cancelled.
  void reset();

  /// The last one of the node's experiments; null before it, and after reset().
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
  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable changed_;
  std::uint64_t results_ = 0;  // that came
  int unexplained_ = 0;        // experiments since the last explanation of the node's own accord
  std::shared_ptr<const Explanation> last_;
  ServiceThread service_thread_;
  ros::ServiceServer service_;
  std::unique_ptr<ActionThread<messages::ExplainExperimentsAction>> action_;
  std::thread thread_;  // last, so that it finds all of the above
};

}  // namespace uncertainty_identification
