#include "math/worker_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <vector>

namespace uncertainty_identification {
namespace {

class Pool : public testing::TestWithParam<int> {};

TEST_P(Pool, TakesEveryTurnOnce) {
  WorkerPool pool(GetParam());
  for (int count : {0, 1, 2, 7, 1000}) {
    std::vector<std::atomic<int>> turns(static_cast<std::size_t>(count));
    pool.forEach(count, [&](int i) { ++turns[static_cast<std::size_t>(i)]; });
    for (const auto& of_turn : turns) ASSERT_EQ(of_turn, 1) << count;
  }
}

TEST_P(Pool, ServesManyLoops) {
  WorkerPool pool(GetParam());
  long total = 0;
  for (int round = 0; round < 500; ++round) {
    std::vector<int> squares(20);
    pool.forEach(20, [&](int i) { squares[static_cast<std::size_t>(i)] = i * i; });
    for (int square : squares) total += square;
  }
  EXPECT_EQ(total, 500L * 2470);
}

TEST_P(Pool, PassesExceptionsOnAndGoesOnWorking) {
  WorkerPool pool(GetParam());
  const auto failing = [](int i) {
    if (i == 5) throw std::domain_error("the fifth");
  };
  for (int round = 0; round < 20; ++round) {
    EXPECT_THROW(pool.forEach(30, failing), std::domain_error);
    std::atomic<int> turns{0};
    pool.forEach(30, [&](int) { ++turns; });
    EXPECT_EQ(turns, 30);
  }
}

TEST_P(Pool, SurvivesWhenEveryTurnFails) {
  WorkerPool pool(GetParam());
  EXPECT_THROW(pool.forEach(30, [](int) { throw std::runtime_error("all"); }), std::runtime_error);
  EXPECT_NO_THROW(pool.forEach(30, [](int) {}));
}

INSTANTIATE_TEST_SUITE_P(Threads, Pool, testing::Values(1, 2, 3, 8));

/// Two turns that wait for each other can only end where two threads work.
TEST(WorkerPool, WorksInParallel) {
  WorkerPool pool(2);
  std::mutex mutex;
  std::condition_variable arrived;
  int present = 0;
  pool.forEach(2, [&](int) {
    std::unique_lock<std::mutex> lock(mutex);
    ++present;
    arrived.notify_all();
    arrived.wait(lock, [&] { return present == 2; });
  });
  EXPECT_EQ(present, 2);
}

}  // namespace
}  // namespace uncertainty_identification
