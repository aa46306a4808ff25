#include "math/interruption.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>

#include "math/worker_pool.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

TEST(Interruption, NothingIsInterruptedByItself) {
  checkpoint();
  const Interruption never([] { return false; });
  checkpoint();
  EXPECT_FALSE(never.requested());
}

TEST(Interruption, ACheckpointThrowsOnceTheEndIsAskedFor) {
  bool stop = false;
  const Interruption interruption([&] { return stop; });
  checkpoint();
  stop = true;
  EXPECT_THROW(for (;;) checkpoint(), CancelledError);
  EXPECT_TRUE(interruption.requested());
  stop = false;
  EXPECT_THROW(checkpoint(), CancelledError) << "there is no way back";
}

TEST(Interruption, EndsWithItsScope) {
  {
    const Interruption interruption([] { return true; });
  }
  checkpoint();
}

TEST(Interruption, InnerWorkEndsWithTheWorkAroundIt) {
  const Interruption outer([] { return true; });
  const Interruption inner([] { return false; });
  EXPECT_THROW(for (;;) checkpoint(), CancelledError);
  EXPECT_TRUE(outer.requested());
  EXPECT_FALSE(inner.requested());
}

TEST(Interruption, OtherThreadsAreNotConcerned) {
  const Interruption interruption([] { return true; });
  std::thread([] { checkpoint(); }).join();
}

/// Every task runs until it is interrupted, whichever thread has it; `stop` is asked in this thread
/// only, also while it waits for the others.
TEST(Interruption, ReachesTheThreadsOfAPool) {
  const auto here = std::this_thread::get_id();
  std::atomic<int> running{0};
  const Interruption interruption([&] {
    EXPECT_EQ(std::this_thread::get_id(), here);
    return running == 3;
  });
  WorkerPool pool(3);
  const auto task = [&](int) {
    ++running;
    for (;;) checkpoint();
  };
  EXPECT_THROW(pool.forEach(3, task), CancelledError);
  EXPECT_EQ(running, 3);
}

TEST(Interruption, AThreadThatWaitsForItsPoolStillAsks) {
  std::atomic<bool> here_done{false};
  const Interruption interruption([&] { return here_done.load(); });
  const auto here = std::this_thread::get_id();
  WorkerPool pool(2);
  const auto task = [&](int) {
    if (std::this_thread::get_id() != here)
      for (;;) checkpoint();
    here_done = true;
  };
  // Which thread gets which task is not determined: until the other thread has had one, repeat.
  EXPECT_THROW(
      for (;;) {
        here_done = false;
        pool.forEach(2, task);
      },
      CancelledError);
}

TEST(Interruption, APoolCanBeUsedAgainAfterwards) {
  WorkerPool pool(2);
  {
    const Interruption interruption([] { return true; });
    EXPECT_THROW(pool.forEach(100, [](int) {}), CancelledError);
  }
  std::atomic<int> done{0};
  pool.forEach(100, [&](int) { ++done; });
  EXPECT_EQ(done, 100);
}

}  // namespace
}  // namespace uncertainty_identification
