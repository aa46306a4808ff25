#include "ros/identification_worker.h"

#include <algorithm>
#include <chrono>
#include <sstream>
#include <utility>

#include "uncertainty_identification/errors.h"

/// The thread that identifies; identification_worker_state.cpp has what others ask of the worker.
namespace uncertainty_identification {
namespace {

constexpr double kSameOptimum = 0.01;  // [nat] what tolerances leave open
constexpr double kLongestQuiet = 3e7;  // [s] clocks count no further than some 9e9

/// Whether the log-likelihoods of two estimates can be compared: same data, same parameters.
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
  text << "identifying from scratch found a better optimum than the results before rested on: "
          "log-likelihood "
       << after.log_likelihood << " instead of " << before.log_likelihood;
  return text.str();
}

}  // namespace

IdentificationWorker::IdentificationWorker(const Configuration& configuration, Listener listener)
    : listener_(std::move(listener)),
      full_(configuration.full_identification),
      identifier_(std::make_shared<const Identifier>(configuration)),
      set_(configuration.limits),
      intake_(
          configuration, [this](LoadedData data) { receive(std::move(data)); },
          [this] { listener_.changed(); }),
      thread_([this] { run(); }) {}

bool IdentificationWorker::wanted(const WorkerSnapshot& at, bool interruptible) const {
  return !stopping_ && resets_ == at.resets && !(interruptible && version_ != at.version);
}

void IdentificationWorker::run() {
  for (Work work; takeWork(work);) {
    if (!work.at.experiments.empty()) update(work);
    change([this] { status_.busy = false; });
  }
}

bool IdentificationWorker::fullIsDue() const {
  const auto fresh = static_cast<double>(seen_ - identified_in_full_);
  return last_ == nullptr || fresh >= full_.share * static_cast<double>(set_.kept().size());
}

/// Whether a full identification is to come if no experiment does.
bool IdentificationWorker::fullFollows() const {
  return last_ != nullptr && full_.quiet > 0 && seen_ != identified_in_full_;
}

/// Waits until experiments came, or did not for so long that all are identified from in full.
bool IdentificationWorker::takeWork(Work& work) {
  std::unique_lock<std::mutex> lock(mutex_);
  const auto changed = [this] { return stopping_ || version_ != seen_; };
  wake_.wait(lock, [&] { return changed() || fullFollows(); });  // which restore() may bring about
  const std::chrono::duration<double> silence(std::min(full_.quiet, kLongestQuiet));
  const bool quiet = !wake_.wait_for(lock, silence, changed);
  if (stopping_) return false;
  seen_ = version_;
  waiting_ = 0;
  status_.busy = true;
  work = {identifier_, snapshotLocked(), last_, last_ != nullptr && !quiet, quiet || fullIsDue(),
          quiet};
  return true;
}

void IdentificationWorker::update(Work& work) {
  const bool done = work.quick && identify(true, work);
  if (done && !work.full) return;
  if (!wanted(work.at, work.interruptible)) return;
  identify(false, work);
  if (wanted(work.at, work.interruptible)) change([&] { identified_in_full_ = work.at.version; });
}

/// Whether it gave a usable result.
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
  const auto progress = [&](const Progress&) { return wanted(work.at, interruptible); };
  return preliminary ? work.identifier->reidentify(*work.last, work.at.experiments, progress)
                     : work.identifier->identify(work.at.experiments, {}, progress);
}

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
    if (!wanted(work.at, false)) return;
    last_ = work.last;
    status_.failed = false;
    status_.termination = last_->termination;
    status_.message = last_->message;
    status_.seconds = last_->seconds;
    status_.iterations = last_->iterations;
    unfit_ = last_->rejected;
    listener_.result(
        {last_, preliminary, windowOf(work.at.experiments), work.identifier->configuration()});
  });
}

void IdentificationWorker::fail(const std::string& message, Termination termination,
                                const Work& work) {
  change([&] {
    if (!wanted(work.at, false)) return;
    status_.failed = true;
    status_.termination = termination;
    status_.message = message;
  });
}

}  // namespace uncertainty_identification
