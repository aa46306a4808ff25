#include "io/interrupt.h"

namespace uncertainty_identification {
namespace {

volatile std::sig_atomic_t stop_requested = 0;

void requestStop(int) { stop_requested = 1; }

// Installs the handler, unless the parent process made this one ignore the signal (nohup,
// background jobs).
void listen(int signal, struct sigaction* before) {
  struct sigaction action {};
  action.sa_handler = requestStop;
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  sigaction(signal, nullptr, before);
  if (before->sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  stop_requested = 0;
  listen(SIGINT, &interrupt_before_);
  listen(SIGTERM, &terminate_before_);
}

InterruptGuard::~InterruptGuard() {
  sigaction(SIGINT, &interrupt_before_, nullptr);
  sigaction(SIGTERM, &terminate_before_, nullptr);
}

bool InterruptGuard::requested() const { return stop_requested != 0; }

}  // namespace uncertainty_identification
