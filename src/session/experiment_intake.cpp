#include "session/experiment_intake.h"

#include <utility>

namespace uncertainty_identification {

ExperimentIntake::ExperimentIntake(const Configuration& configuration,
                                   std::function<void(LoadedData)> deliver,
                                   std::function<void()> processed)
    : deliver_(std::move(deliver)),
      processed_(std::move(processed)),
      configured_sample_time_(configuration.sample_time),
      resampling_(configuration.resampling),
      thread_([this] { run(); }) {}

ExperimentIntake::~ExperimentIntake() {
  queue_.close();
  thread_.join();
}

void ExperimentIntake::add(FinishedExperiment finished) {
  ++waiting_;
  queue_.push({generation_, std::move(finished)});
}

void ExperimentIntake::clear() {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++generation_;
  first_sample_time_.reset();
}

void ExperimentIntake::configure(const Configuration& configuration) {
  const std::lock_guard<std::mutex> lock(mutex_);
  configured_sample_time_ = configuration.sample_time;
  resampling_ = configuration.resampling;
}

void ExperimentIntake::setFirstSampleTime(double sample_time) {
  const std::lock_guard<std::mutex> lock(mutex_);
  first_sample_time_ = sample_time;
}

void ExperimentIntake::run() {
  for (auto items = queue_.takeAll(); !items.empty(); items = queue_.takeAll()) {
    for (auto& item : items) {
      {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (item.generation == generation_) deliver_(load(std::move(item.finished)));
        --waiting_;
      }
      processed_();
    }
  }
}

LoadedData ExperimentIntake::load(FinishedExperiment finished) {
  LoadedData data;
  if (auto* recording = std::get_if<Recording>(&finished)) {
    addResampled(*recording, configured_sample_time_, resampling_, data,
                 first_sample_time_.value_or(0));
  } else if (auto* experiment = std::get_if<Experiment>(&finished)) {
    data.experiments.push_back(std::move(*experiment));
  } else {
    data.rejected.push_back(std::get<RejectedExperiment>(std::move(finished)));
  }
  if (!first_sample_time_ && !data.experiments.empty())
    first_sample_time_ = data.experiments.front().sample_time;
  return data;
}

}  // namespace uncertainty_identification
