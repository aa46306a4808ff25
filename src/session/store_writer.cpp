#include "session/store_writer.h"

#include <algorithm>
#include <utility>

#include "data/text.h"

namespace uncertainty_identification {
namespace {

constexpr std::chrono::milliseconds kRetryInterval(1000);
constexpr int kLeastCapacity = 1000;  // files that may wait, also when fewer experiments are kept

}  // namespace

StoreWriter::StoreWriter(const std::string& directory, ExperimentFiles files,
                         const LimitOptions& limits, Listener listener)
    : listener_(std::move(listener)),
      limits_(limits),
      store_(directory, std::move(files)),
      queue_(static_cast<std::size_t>(std::max(limits.max_experiments, kLeastCapacity)),
             kRetryInterval, [this] { listener_.changed(status()); }) {}

StoreWriter::~StoreWriter() {
  const std::vector<std::string> left = queue_.stop();
  if (!left.empty()) listener_.unwritten(left);
}

StoredState StoreWriter::load() {
  StoredState state = store_.load(limits_);
  change([&](StoreStatus& status) {
    status.stored = state.count;
    if (!state.kept.empty()) status.last_id = state.kept.back().experiment->id;
  });
  return state;
}

void StoreWriter::change(const std::function<void(StoreStatus&)>& change) {
  const std::lock_guard<std::mutex> lock(mutex_);
  change(status_);
}

void StoreWriter::keep(const KeptExperiment& experiment) {
  const auto write = [this, experiment] {
    store_.write(experiment);
    change([&](StoreStatus& status) {
      ++status.stored;
      status.last_id = experiment.experiment->id;
    });
  };
  queue_.push(write, "", named(experiment.experiment->id));
}

void StoreWriter::keep(const StoredResult& result) {
  queue_.push([this, result] { store_.write(result); }, "result",
              "result " + std::to_string(result.context.sequence));
}

void StoreWriter::keep(const StoredConfiguration& configuration) {
  queue_.push([this, configuration] { store_.write(configuration); }, "configuration",
              "the configuration");
}

void StoreWriter::reject(std::uint64_t number, const RejectedExperiment& rejected) {
  const auto move = [this, number, rejected] {
    store_.reject(number, rejected);
    change([](StoreStatus& status) { --status.stored; });
  };
  queue_.push(move, "", "the rejection of " + named(rejected.id));
}

void StoreWriter::reject(const RejectedExperiment& rejected) {
  queue_.push([this, rejected] { store_.reject(rejected, limits_.max_experiments); }, "",
              "the rejection of " + named(rejected.id));
}

void StoreWriter::reset() {
  queue_.push(
      [this] {
        store_.reset();
        change([](StoreStatus& status) { status = {}; });
      },
      "result",  // with this key a result that still waits is not written
      "the reset");
}

StoreStatus StoreWriter::status() const {
  const RetryQueue::Status queue = queue_.status();
  const std::lock_guard<std::mutex> lock(mutex_);
  StoreStatus status = status_;
  status.pending = queue.waiting;
  status.lost = queue.lost;
  status.failing = queue.failing;
  if (queue.failing) {
    status.message = "the store: " + queue.message + "; " + std::to_string(queue.waiting) +
                     " files wait in memory until they can be written";
  } else if (queue.lost > 0) {
    status.message = "the store: " + std::to_string(queue.lost) + " files were given up" +
                     (queue.message.empty() ? "" : "; " + queue.message);
  }
  return status;
}

}  // namespace uncertainty_identification
