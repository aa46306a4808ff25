#include "live/live_page.h"

#include <chrono>
#include <string>
#include <utility>

#include "io/report.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

constexpr std::chrono::milliseconds kPause{200};  // between two questions to the source
constexpr const char* kNothing = "null";

/// The page as it is sent. Throws ConfigurationError when it cannot be drawn.
std::string drawablePage() {
  const std::string obstacle = reportObstacle();
  if (!obstacle.empty())
    throw ConfigurationError("live_page.port: no page can be drawn: " + obstacle);
  return livePageHtml();
}

}  // namespace

LivePage::LivePage(int port, Source source)
    : source_(std::move(source)), server_(startLiveServer(port, drawablePage(), board_)) {}

void LivePage::start() {
  thread_ = std::thread([this] { run(); });
}

void LivePage::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_one();
  if (thread_.joinable()) thread_.join();
  server_.reset();
}

void LivePage::changed() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    changed_ = true;
  }
  wake_.notify_one();
}

void LivePage::changed(const Progress& progress) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    progress_ = progress;
    changed_ = true;
  }
  wake_.notify_one();
}

void LivePage::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return stopping_ || changed_; });
    if (stopping_) return;
    changed_ = false;
    const std::optional<Progress> progress = progress_;
    lock.unlock();
    board_.post("status", liveStatus(source_.status(), progress ? &*progress : nullptr));
    board_.post("experiments", liveExperiments(source_.experiments()));
    lock.lock();
    wake_.wait_for(lock, kPause, [this] { return stopping_; });
  }
}

void LivePage::show(const Result& result, const ResultContext& context) {
  std::string text = liveResult(result, context);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (context.sequence > forgotten_) board_.post("result", std::move(text));
}

void LivePage::show(const Explanation& explanation) {
  board_.post("explanation", liveExplanation(explanation));
}

void LivePage::forget(std::uint32_t last_sequence) {
  const std::lock_guard<std::mutex> lock(mutex_);
  forgotten_ = last_sequence;
  board_.post("result", kNothing);
  board_.post("explanation", kNothing);
}

}  // namespace uncertainty_identification
