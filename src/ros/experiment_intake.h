#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <thread>
#include <variant>

#include "ros/work_queue.h"
#include "uncertainty_identification/configuration.h"
#include "uncertainty_identification/data/loaded_data.h"

namespace uncertainty_identification {

/// What a recorder hands on: the raw material of an experiment, a complete one, or the reason why
/// there is none.
using FinishedExperiment = std::variant<Recording, Experiment, RejectedExperiment>;

/// Makes experiments of what a recorder hands on, in a thread of its own, so that recording does
/// not wait for resampling, nor an experiment for an identification. Knows no ROS.
class ExperimentIntake {
 public:
  using Receiver = std::function<void(LoadedData)>;

  /// `receive` is called from the intake's thread, for one finished experiment at a time, and then
  /// `received`, once that is no longer counted by waiting().
  ExperimentIntake(const Configuration& configuration, Receiver receive,
                   std::function<void()> received);

  /// Hands on what waits.
  ~ExperimentIntake();

  ExperimentIntake(const ExperimentIntake&) = delete;
  ExperimentIntake& operator=(const ExperimentIntake&) = delete;

  void add(FinishedExperiment experiment);

  /// Drops what waits, and forgets the common sample time; none of it is received any more.
  void clear();

  /// From now on. What was received keeps its samples.
  void configure(const Configuration& configuration);

  /// The sample time [s] of experiments received before the intake was there.
  void setCommonSampleTime(double sample_time);

  /// Experiments that were not received yet.
  int waiting() const { return waiting_; }

 private:
  struct Item {
    unsigned clearings;  // as many as there had been
    FinishedExperiment experiment;
  };

  void run();
  LoadedData load(FinishedExperiment experiment);

  const Receiver receive_;
  const std::function<void()> received_;
  WorkQueue<Item> queue_;
  std::atomic<unsigned> clearings_{0};
  std::atomic<int> waiting_{0};

  std::mutex mutex_;  // held while an experiment is made and received; guards what follows
  double sample_time_;
  ResamplingOptions resampling_;
  double common_sample_time_ = 0;  // [s] of the first experiment; 0 before

  std::thread thread_;  // last, so that it finds all of the above
};

}  // namespace uncertainty_identification
