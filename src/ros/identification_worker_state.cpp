#include <utility>

#include "ros/identification_worker.h"

/// What others ask of the worker, from any thread.
namespace uncertainty_identification {

IdentificationWorker::~IdentificationWorker() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void IdentificationWorker::change(const std::function<void()>& change) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    change();
  }
  wake_.notify_all();
  listener_.changed();
}

void IdentificationWorker::add(FinishedExperiment experiment) {
  intake_.add(std::move(experiment));
  listener_.changed();
}

void IdentificationWorker::receive(LoadedData data) {
  for (const auto& warning : data.warnings) listener_.warning(warning);
  for (const auto& rejected : data.rejected) listener_.warning(rejected.reason);
  change([&] {
    status_.failed = !data.rejected.empty();
    if (status_.failed) status_.message = data.rejected.back().reason;
    for (const auto& rejected : data.rejected) listener_.rejected(rejected);
    const std::size_t finished = data.experiments.size();
    const auto added = set_.add(std::move(data));
    if (added.size() < finished)
      listener_.warning(
          "an experiment with the stamps and samples of an earlier one came again, as from a bag "
          "played in a loop; it is not counted twice");
    for (const auto& kept : added) {
      listener_.kept(kept);
      ++version_;
      ++waiting_;
    }
  });
}

void IdentificationWorker::restore(std::vector<KeptExperiment> kept,
                                   std::vector<RejectedExperiment> rejected, std::uint64_t last,
                                   const std::optional<WorkerResult>& result) {
  if (!kept.empty()) intake_.setCommonSampleTime(kept.front().experiment->sample_time);
  change([&] {
    set_.restore(std::move(kept), std::move(rejected), last);
    version_ = set_.kept().size();
    if (!result) return;
    last_ = result->estimate;
    status_.termination = last_->termination;
    status_.message = last_->message;
    unfit_ = last_->rejected;
    const ExperimentWindow now = windowOf(snapshotLocked().experiments), &then = result->window;
    if (now.count != then.count || now.first_id != then.first_id || now.last_id != then.last_id)
      return;
    seen_ = version_;
    if (!result->preliminary) identified_in_full_ = version_;
  });
}

std::optional<std::uint64_t> IdentificationWorker::reject(const std::string& id,
                                                          const std::string& reason) {
  std::optional<std::uint64_t> number;
  change([&] {
    number = set_.reject(id, reason);
    if (number) ++version_;
  });
  return number;
}

bool IdentificationWorker::readmit(const Experiment& experiment) {
  const std::lock_guard<std::mutex> lock(mutex_);
  return set_.readmit(experiment);
}

void IdentificationWorker::reset() {
  intake_.clear();
  change([this] {
    ++resets_;
    ++version_;
    set_.clear();
    last_.reset();
    const bool busy = status_.busy;  // until the worker notices that it is to stop
    status_ = {};
    status_.busy = busy;
    status_.message = "reset; no experiment has finished since";
    waiting_ = 0;
    unfit_.clear();
  });
}

WorkerSnapshot IdentificationWorker::snapshotLocked() const {
  WorkerSnapshot snapshot{{}, version_, resets_};
  for (const auto& kept : set_.kept()) snapshot.experiments.push_back(*kept.experiment);
  return snapshot;
}

WorkerSnapshot IdentificationWorker::snapshot() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return snapshotLocked();
}

void IdentificationWorker::adopt(const Configuration& configuration,
                                 std::shared_ptr<const Estimate> estimate,
                                 const WorkerSnapshot& snapshot) {
  auto identifier = std::make_shared<const Identifier>(configuration);
  intake_.configure(configuration);
  change([&] {
    full_ = configuration.full_identification;
    identifier_ = std::move(identifier);
    set_.setLimits(configuration.limits);
    last_ = snapshot.resets == resets_ ? std::move(estimate) : nullptr;
    ++resets_;
    seen_ = identified_in_full_ = snapshot.version;
    if (last_ == nullptr) return;
    status_.failed = false;
    status_.termination = last_->termination;
    status_.message = last_->message;
    status_.seconds = last_->seconds;
    status_.iterations = last_->iterations;
    unfit_ = last_->rejected;
    listener_.result({last_, false, windowOf(snapshot.experiments), configuration});
  });
}

WorkerStatus IdentificationWorker::status() const {
  const int coming = intake_.waiting();  // first: what comes meanwhile is counted below
  const std::lock_guard<std::mutex> lock(mutex_);
  WorkerStatus status = status_;
  status.queue = coming + waiting_;
  status.busy = status.busy || status.queue > 0 || version_ != seen_ || fullFollows();
  status.stored = static_cast<int>(set_.kept().size());
  if (set_.kept().empty()) return status;
  status.last_id = set_.kept().back().experiment->id;
  status.timing = set_.kept().back().experiment->timing;
  return status;
}

std::vector<ExperimentDigest> IdentificationWorker::experiments() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  auto digests = set_.digests();
  for (const auto& unfit : unfit_)
    for (auto& digest : digests)
      if (digest.id == unfit.id && digest.rejected.empty()) digest.rejected = unfit.reason;
  return digests;
}

}  // namespace uncertainty_identification
