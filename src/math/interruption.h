#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

namespace uncertainty_identification {

/// Ends a computation that is no longer wanted, however deep in it the thread is.
///
/// While an object of this class exists, checkpoint() throws CancelledError once `stop` has
/// returned true: in the thread that constructed the object, and in the threads of a WorkerPool
/// while they work for it. This is what boost::this_thread::interruption_point() does for
/// boost::thread, for work that several threads share. Objects may be nested; the inner work ends
/// when either is asked to.
class Interruption {
 public:
  /// `stop` is called in the constructing thread only, at most once in a few milliseconds.
  explicit Interruption(std::function<bool()> stop);
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Whether `stop` has returned true. May be called from any thread.
  bool requested() const { return requested_; }

  /// The innermost object that applies to this thread; null: none.
  static Interruption* current();

  /// Applies `interruption` to a thread that works for its owner, as long as the scope exists.
  class Scope {
   public:
    explicit Scope(Interruption* interruption);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Interruption* before_;
  };

  /// Asks `stop` if it is due and the calling thread is the one that may. Returns whether this
  /// object or one around it is asked to end.
  bool poll();

 private:
  std::function<bool()> stop_;
  const std::thread::id owner_ = std::this_thread::get_id();
  Interruption* const outer_;
  std::chrono::steady_clock::time_point due_{};
  std::atomic<bool> requested_{false};
};

/// Throws CancelledError if an Interruption that applies to this thread asks for the end of the
/// work. Takes nanoseconds; to be called wherever work may take longer than some 10 ms.
void checkpoint();

}  // namespace uncertainty_identification
