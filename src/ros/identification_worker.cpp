#include "uncertainty_identification/ros/identification_worker.h"

#include <utility>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
IdentificationWorker::IdentificationWorker(const Configuration& configuration, Listener listener)
    : configuration_(configuration),
      identifier_(configuration),
      listener_(std::move(listener)),
      set_(configuration.limits),
      thread_([this] { run(); }) {}

IdentificationWorker::~IdentificationWorker() {
  stopping_ = true;
  queue_.close();
  thread_.join();
}

void IdentificationWorker::add(FinishedExperiment experiment) {
  queue_.push({resets_, std::move(experiment)});
  listener_.changed();
}

void IdentificationWorker::reset() {
  change([this] {
    ++resets_;
    queue_.clear();
    const bool busy = status_.busy;  // until the worker notices that it is to stop
    status_ = {};
    status_.busy = busy;
    status_.message = "reset; no experiment has finished since";
    unfit_.clear();
  });
}

WorkerStatus IdentificationWorker::status() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  WorkerStatus status = status_;
  status.queue = static_cast<int>(queue_.size());
  status.busy = status.busy || status.queue > 0;
  return status;
}

std::vector<ExperimentDigest> IdentificationWorker::experiments() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (resets_ != resets_seen_) return {};
  auto digests = set_.digests();
  for (const auto& unfit : unfit_)
    for (auto& digest : digests)
      if (digest.id == unfit.id && digest.rejected.empty()) digest.rejected = unfit.reason;
  return digests;
}

template <typename Change>
void IdentificationWorker::change(const Change& change) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    change();
  }
  listener_.changed();
}

bool IdentificationWorker::wanted(bool interruptible) const {
  return !stopping_ && resets_ == resets_seen_ && !(interruptible && queue_.size() > 0);
}

void IdentificationWorker::run() {
  for (auto items = queue_.takeAll(); !items.empty(); items = queue_.takeAll()) {
    absorb(std::move(items));
    update();
    change([this] { status_.busy = false; });
  }
}

LoadedData IdentificationWorker::load(std::vector<Item> items, unsigned resets) const {
  LoadedData data;
  for (auto& item : items) {
    if (item.resets != resets) continue;
    if (auto* recording = std::get_if<Recording>(&item.experiment)) {
      addResampled(*recording, configuration_.sample_time, configuration_.resampling, data);
    } else if (auto* experiment = std::get_if<Experiment>(&item.experiment)) {
      data.experiments.push_back(std::move(*experiment));
    } else {
      data.rejected.push_back(std::get<RejectedExperiment>(std::move(item.experiment)));
    }
  }
  return data;
}

void IdentificationWorker::absorb(std::vector<Item> items) {
  const unsigned resets = resets_;
  LoadedData data = load(std::move(items), resets);
  for (const auto& warning : data.warnings) listener_.warning(warning);
  for (const auto& rejected : data.rejected) listener_.warning(rejected.reason);
  change([&] {
    if (resets_ != resets_seen_) {
      resets_seen_ = resets_;
      last_.reset();
      set_ = ExperimentSet(configuration_.limits);
    }
    if (resets_ != resets) return;
    status_.failed = !data.rejected.empty();
    if (status_.failed) status_.message = data.rejected.back().reason;
    set_.add(std::move(data));
    status_.busy = true;
    status_.stored = static_cast<int>(set_.experiments().size());
    status_.last_id = set_.experiments().empty() ? "" : set_.experiments().back().id;
  });
}

void IdentificationWorker::update() {
  if (set_.experiments().empty()) return;
  if (last_) identify(true);
  if (wanted(true)) identify(false);
}

void IdentificationWorker::identify(bool preliminary) {
  try {
    Estimate result = estimate(preliminary);
    if (result.usable()) return succeed(std::move(result), preliminary);
    if (result.termination != Termination::cancelled)
      fail("no usable model was found: " + result.message, result.termination);
  } catch (const Error& error) {
    fail(error.what(), Termination::not_run);
  } catch (const std::exception& error) {
    fail(std::string("internal error: ") + error.what(), Termination::not_run);
  }
}

Estimate IdentificationWorker::estimate(bool preliminary) {
  const bool interruptible = !preliminary && last_ != nullptr;
  const auto progress = [this, interruptible](const Progress&) { return wanted(interruptible); };
  return preliminary ? identifier_.reidentify(*last_, set_.experiments(), progress)
                     : identifier_.identify(set_.experiments(), {}, progress);
}

void IdentificationWorker::succeed(Estimate estimate, bool preliminary) {
  const auto result = std::make_shared<const Estimate>(std::move(estimate));
  change([&] {
    if (!wanted(false)) return;
    last_ = result;
    status_.failed = false;
    status_.termination = result->termination;
    status_.message = result->message;
    status_.seconds = result->seconds;
    status_.iterations = result->iterations;
    unfit_ = result->rejected;
    listener_.result({result, preliminary, timeWindow(set_.experiments())});
  });
}

void IdentificationWorker::fail(const std::string& message, Termination termination) {
  change([&] {
    if (!wanted(false)) return;
    status_.failed = true;
    status_.termination = termination;
    status_.message = message;
  });
}

}  // namespace uncertainty_identification
