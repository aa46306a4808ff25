#include <algorithm>
#include <utility>

#include "session/identification_worker.h"

/// The functions that other threads call. The identifying thread is in identification_worker.cpp.
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
          "an experiment with the stamps and samples of an earlier one arrived again, as from a "
          "bag "
          "played in a loop; it is not used twice");
    for (const auto& kept : added) {
      listener_.kept(kept);
      ++version_;
      ++waiting_;
    }
  });
}

void IdentificationWorker::restore(std::vector<KeptExperiment> kept,
                                   std::vector<RejectedExperiment> rejected,
                                   std::uint64_t last_number,
                                   const std::optional<WorkerResult>& result) {
  if (!kept.empty()) intake_.setFirstSampleTime(kept.front().experiment->sample_time);
  change([&] {
    set_.restore(std::move(kept), std::move(rejected), last_number);
    version_ = set_.kept().size();
    if (!result) return;
    last_ = result->estimate;
    status_.termination = last_->termination;
    status_.message = last_->message;
    status_.trust = last_->trust;
    unusable_ = last_->rejected;
    const ExperimentWindow now = windowOf(snapshotLocked().experiments);
    const ExperimentWindow& then = result->window;
    if (now.count != then.count || now.first_id != then.first_id || now.last_id != then.last_id)
      return;
    version_taken_ = version_;
    if (!result->preliminary) version_fully_identified_ = version_;
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
    ++generation_;
    ++version_;
    set_.clear();
    last_.reset();
    const bool busy = status_.busy;  // stays true until the thread has noticed the cancellation
    status_ = {};
    status_.busy = busy;
    status_.message = "reset; no experiment has finished since";
    waiting_ = 0;
    unusable_.clear();
  });
}

WorkerSnapshot IdentificationWorker::snapshotLocked() const {
  WorkerSnapshot snapshot{{}, version_, generation_};
  for (const auto& kept : set_.kept()) snapshot.experiments.push_back(*kept.experiment);
  return snapshot;
}

WorkerSnapshot IdentificationWorker::snapshot() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return snapshotLocked();
}

/// Puts how an identification went into the status.
void IdentificationWorker::setStatusFrom(const Estimate& estimate) {
  status_.failed = false;
  status_.termination = estimate.termination;
  status_.trust = estimate.trust;
  status_.message = estimate.message;
  status_.seconds = estimate.seconds;
  status_.iterations = estimate.iterations;
  unusable_ = estimate.rejected;
}

/// The last result, made from these experiments.
WorkerResult IdentificationWorker::resultLocked(bool preliminary,
                                                const std::vector<Experiment>& experiments,
                                                const Configuration& configuration) const {
  const auto digests = digestsLocked();
  const auto rejected = std::count_if(digests.begin(), digests.end(),
                                      [](const auto& digest) { return !digest.rejected.empty(); });
  return {last_,         preliminary, windowOf(experiments),
          configuration, set_.kept(), static_cast<int>(rejected)};
}

void IdentificationWorker::adopt(const Configuration& configuration,
                                 std::shared_ptr<const Estimate> estimate,
                                 const WorkerSnapshot& snapshot) {
  auto identifier = std::make_shared<const Identifier>(configuration);
  intake_.configure(configuration);
  change([&] {
    full_options_ = configuration.full_identification;
    identifier_ = std::move(identifier);
    set_.setLimits(configuration.limits);
    last_ = snapshot.generation == generation_ ? std::move(estimate) : nullptr;
    ++generation_;
    version_taken_ = version_fully_identified_ = snapshot.version;
    if (last_ == nullptr) return;
    setStatusFrom(*last_);
    listener_.result(resultLocked(false, snapshot.experiments, configuration));
  });
}

WorkerStatus IdentificationWorker::status() const {
  const int coming =
      intake_
          .waiting();  // read first: an experiment that moves on meanwhile is counted in waiting_
  const std::lock_guard<std::mutex> lock(mutex_);
  WorkerStatus status = status_;
  status.queue = coming + waiting_;
  status.busy = status.busy || status.queue > 0 || version_ != version_taken_ || fullFollows();
  status.stored = static_cast<int>(set_.kept().size());
  if (set_.kept().empty()) return status;
  status.last_id = set_.kept().back().experiment->id;
  status.timing = set_.kept().back().experiment->timing;
  return status;
}

std::vector<ExperimentDigest> IdentificationWorker::experiments() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return digestsLocked();
}

std::vector<ExperimentDigest> IdentificationWorker::digestsLocked() const {
  auto digests = set_.digests();
  for (const auto& unusable : unusable_)
    for (auto& digest : digests)
      if (digest.id == unusable.id && digest.rejected.empty()) digest.rejected = unusable.reason;
  return digests;
}

}  // namespace uncertainty_identification
