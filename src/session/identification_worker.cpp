#include "session/identification_worker.h"

#include <algorithm>
#include <chrono>
#include <sstream>
#include <utility>

#include "uncertainty_identification/errors.h"

/// The thread that identifies. What other threads call is in identification_worker_state.cpp.
namespace uncertainty_identification {
namespace {

// [nats] Log-likelihoods that differ by less belong to the same optimum: the optimisers' tolerances
// leave such differences.
constexpr double kSameOptimum = 0.01;
// [s] about a year; wait_for() overflows with durations above some 9e9 s.
constexpr double kLongestQuiet = 3e7;

/// Whether two log-likelihoods can be compared: they must be of the same data and of models with
/// the same parameters.
bool comparable(const Estimate& one, const Estimate& other) {
  const auto sameSize = [](const auto& a, const auto& b) { return a.size() == b.size(); };
  return one.data_fingerprint == other.data_fingerprint &&
         one.nominal_model.structure == other.nominal_model.structure &&
         one.nominal_model.delay == other.nominal_model.delay &&
         sameSize(one.nominal_model.parameters, other.nominal_model.parameters) &&
         sameSize(one.error_model.parameters, other.error_model.parameters);
}

std::string foundBetter(const Estimate& before, const Estimate& after) {
  std::ostringstream text;
  text << "identifying from scratch found a better optimum than that of the results before: "
          "log-likelihood "
       << after.log_likelihood << " instead of " << before.log_likelihood;
  return text.str();
}

}  // namespace

IdentificationWorker::IdentificationWorker(const Configuration& configuration, Listener listener)
    : listener_(std::move(listener)),
      full_options_(configuration.full_identification),
      identifier_(std::make_shared<const Identifier>(configuration)),
      set_(configuration.limits),
      intake_(
          configuration, [this](LoadedData data) { receive(std::move(data)); },
          [this] { listener_.changed(); }),
      thread_([this] { run(); }) {}

/// Whether work on this snapshot is still wanted.
bool IdentificationWorker::isCurrent(const WorkerSnapshot& snapshot, bool interruptible) const {
  return !stopping_ && generation_ == snapshot.generation &&
         !(interruptible && version_ != snapshot.version);
}

void IdentificationWorker::run() {
  for (Work work; takeWork(work);) {
    if (!work.snapshot.experiments.empty()) {
      const auto running =
          listener_.begins("identifying from " + std::to_string(work.snapshot.experiments.size()) +
                           " of the node's experiments");
      carryOut(work);
    }
    change([this] { status_.busy = false; });
  }
}

/// Whether so many experiments are new that they are identified from scratch at once.
bool IdentificationWorker::fullIsDue() const {
  const auto changes = static_cast<double>(version_taken_ - version_fully_identified_);
  return last_ == nullptr ||
         changes >= full_options_.share * static_cast<double>(set_.kept().size());
}

/// Whether a full identification starts when no new experiment arrives for a while.
bool IdentificationWorker::fullFollows() const {
  return last_ != nullptr && full_options_.quiet > 0 && version_taken_ != version_fully_identified_;
}

/// Waits until the experiments have changed, or have not changed for so long that a full
/// identification is due. Returns false when the worker ends.
bool IdentificationWorker::takeWork(Work& work) {
  std::unique_lock<std::mutex> lock(mutex_);
  const auto changed = [this] { return stopping_ || version_ != version_taken_; };
  wake_.wait(lock, [&] { return changed() || fullFollows(); });  // restore() can change either
  const std::chrono::duration<double> silence(std::min(full_options_.quiet, kLongestQuiet));
  const bool quiet = !wake_.wait_for(lock, silence, changed);
  if (stopping_) return false;
  version_taken_ = version_;
  waiting_ = 0;
  status_.busy = true;
  work = {identifier_, snapshotLocked(), last_, last_ != nullptr && !quiet, quiet || fullIsDue(),
          quiet};
  return true;
}

void IdentificationWorker::carryOut(Work& work) {
  const bool done = work.quick && identify(true, work);
  if (done && !work.full) return;
  if (!isCurrent(work.snapshot, work.interruptible)) return;
  identify(false, work);
  if (isCurrent(work.snapshot, work.interruptible))
    change([&] { version_fully_identified_ = work.snapshot.version; });
}

/// Returns whether there is a usable result.
bool IdentificationWorker::identify(bool preliminary, Work& work) {
  try {
    Estimate result = estimate(preliminary, work);
    if (result.usable()) {
      succeed(std::move(result), preliminary, work);
      return true;
    }
    if (result.termination != Termination::cancelled)
      fail("no usable model was found: " + result.message, result.termination, work);
  } catch (const Error& error) {
    fail(error.what(), Termination::not_run, work);
  } catch (const std::exception& error) {
    fail(std::string("internal error: ") + error.what(), Termination::not_run, work);
  }
  return false;
}

Estimate IdentificationWorker::estimate(bool preliminary, const Work& work) {
  const bool interruptible = !preliminary && work.interruptible;
  const auto progress = [&](const Progress& now) {
    listener_.progress(now);
    return isCurrent(work.snapshot, interruptible);
  };
  return preliminary ? work.identifier->reidentify(*work.last, work.snapshot.experiments, progress)
                     : work.identifier->identify(work.snapshot.experiments, {}, progress);
}

/// Keeps the better of the new and the last result, and publishes it.
void IdentificationWorker::succeed(Estimate estimate, bool preliminary, Work& work) {
  if (!preliminary && work.last != nullptr && comparable(*work.last, estimate)) {
    const double gain = estimate.log_likelihood - work.last->log_likelihood;
    if (gain > kSameOptimum) {
      estimate.warnings.push_back(foundBetter(*work.last, estimate));
      listener_.warning(estimate.warnings.back());
    } else if (gain < -kSameOptimum) {
      estimate = *work.last;
    }
  }
  work.last = std::make_shared<const Estimate>(std::move(estimate));
  change([&] {
    if (!isCurrent(work.snapshot, false)) return;
    last_ = work.last;
    setStatusFrom(*last_);
    listener_.result(
        resultLocked(preliminary, work.snapshot.experiments, work.identifier->configuration()));
  });
}

void IdentificationWorker::fail(const std::string& message, Termination termination,
                                const Work& work) {
  if (isCurrent(work.snapshot, false)) listener_.warning(message);
  change([&] {
    if (!isCurrent(work.snapshot, false)) return;
    status_.failed = true;
    status_.termination = termination;
    status_.message = message;
  });
}

}  // namespace uncertainty_identification
