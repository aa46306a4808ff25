#include "math/interruption.h"

#include <utility>

#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

thread_local Interruption* current_interruption = nullptr;

}  // namespace

Interruption::Interruption(std::function<bool()> stop)
    : stop_(std::move(stop)), outer_(std::exchange(current_interruption, this)) {}

Interruption::~Interruption() { current_interruption = outer_; }

Interruption* Interruption::current() { return current_interruption; }

Interruption::Scope::Scope(Interruption* interruption)
    : before_(std::exchange(current_interruption, interruption)) {}

Interruption::Scope::~Scope() { current_interruption = before_; }

bool Interruption::poll() {
  constexpr std::chrono::milliseconds kPeriod{5};
  if (!requested_ && owner_ == std::this_thread::get_id()) {
    const auto now = std::chrono::steady_clock::now();
    if (now >= due_) {
      due_ = now + kPeriod;
      if (stop_()) requested_ = true;
    }
  }
  const bool around = outer_ != nullptr && outer_->poll();
  return requested_ || around;
}

void checkpoint() {
  if (current_interruption != nullptr && current_interruption->poll())
    throw CancelledError("cancelled");
}

}  // namespace uncertainty_identification
