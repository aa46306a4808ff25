#include "ros/experiment_intake.h"

#include <utility>

namespace uncertainty_identification {

ExperimentIntake::ExperimentIntake(const Configuration& configuration, Receiver receive,
                                   std::function<void()> received)
    : receive_(std::move(receive)),
      received_(std::move(received)),
      sample_time_(configuration.sample_time),
      resampling_(configuration.resampling),
      thread_([this] { run(); }) {}

ExperimentIntake::~ExperimentIntake() {
  queue_.close();
  thread_.join();
}

void ExperimentIntake::add(FinishedExperiment experiment) {
  ++waiting_;
  queue_.push({clearings_, std::move(experiment)});
}

void ExperimentIntake::clear() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++clearings_;
  common_sample_time_ = 0;
}

void ExperimentIntake::configure(const Configuration& configuration) {
  const std::lock_guard<std::mutex> lock(mutex_);
  sample_time_ = configuration.sample_time;
  resampling_ = configuration.resampling;
}

void ExperimentIntake::setCommonSampleTime(double sample_time) {
  const std::lock_guard<std::mutex> lock(mutex_);
  common_sample_time_ = sample_time;
}

void ExperimentIntake::run() {
  for (auto items = queue_.takeAll(); !items.empty(); items = queue_.takeAll()) {
    for (auto& item : items) {
      {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (item.clearings == clearings_) receive_(load(std::move(item.experiment)));
        --waiting_;
      }
      received_();
    }
  }
}

LoadedData ExperimentIntake::load(FinishedExperiment finished) {
  LoadedData data;
  if (auto* recording = std::get_if<Recording>(&finished)) {
    addResampled(*recording, sample_time_, resampling_, data, common_sample_time_);
  } else if (auto* experiment = std::get_if<Experiment>(&finished)) {
    data.experiments.push_back(std::move(*experiment));
  } else {
    data.rejected.push_back(std::get<RejectedExperiment>(std::move(finished)));
  }
  if (common_sample_time_ == 0 && !data.experiments.empty())
    common_sample_time_ = data.experiments.front().sample_time;
  return data;
}

}  // namespace uncertainty_identification
