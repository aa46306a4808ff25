#include "session/retry_queue.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <memory>
#include <vector>

#include "support/wait_for.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

constexpr std::chrono::milliseconds kInterval(1);

TEST(RetryQueue, TriesATaskUntilItSucceedsAndKeepsTheOrder) {
  std::atomic<int> refusals{5};
  std::vector<int> done;
  RetryQueue queue(10, kInterval, [] {});
  queue.push([&] {
    if (refusals-- > 0) throw FileError("the disk is full");
    done.push_back(1);
  });
  queue.push([&] { done.push_back(2); });
  ASSERT_TRUE(waitFor([&] { return queue.status().waiting == 0; }));
  EXPECT_EQ(done, (std::vector<int>{1, 2}));
  EXPECT_FALSE(queue.status().failing);
  EXPECT_EQ(queue.status().message, "");
  EXPECT_EQ(queue.status().lost, 0);
}

TEST(RetryQueue, TellsWhyItWaits) {
  std::atomic<bool> full{true};
  RetryQueue queue(10, kInterval, [] {});
  queue.push([&] {
    if (full) throw FileError("the disk is full");
  });
  ASSERT_TRUE(waitFor([&] { return queue.status().failing; }));
  EXPECT_EQ(queue.status().message, "the disk is full");
  EXPECT_EQ(queue.status().waiting, 1);
  full = false;
  EXPECT_TRUE(waitFor([&] { return queue.status().waiting == 0; }));
}

// A disk that does not answer: whoever pushes goes on.
TEST(RetryQueue, NobodyWaitsForASlowTask) {
  std::promise<void> answer;
  std::atomic<int> done{0};
  RetryQueue queue(10, kInterval, [] {});
  queue.push([&] {
    answer.get_future().wait();
    ++done;
  });
  for (int k = 0; k < 5; ++k) queue.push([&] { ++done; });
  EXPECT_EQ(done, 0);
  EXPECT_EQ(queue.status().waiting, 6);
  answer.set_value();
  EXPECT_TRUE(waitFor([&] { return done == 6; }));
}

TEST(RetryQueue, GivesUpWhatCannotBeDoneAndTheOldestOfTooMany) {
  std::atomic<bool> full{true};
  std::vector<int> done;
  RetryQueue queue(2, kInterval, [] {});
  queue.push([] { throw DataError("a stamp of the year 1900"); });
  ASSERT_TRUE(waitFor([&] { return queue.status().lost == 1; }));
  queue.push([&] {
    if (full) throw FileError("the disk is full");
  });
  ASSERT_TRUE(waitFor([&] { return queue.status().failing; }));
  for (int k = 0; k < 5; ++k) queue.push([&done, k] { done.push_back(k); });
  full = false;
  ASSERT_TRUE(waitFor([&] { return queue.status().waiting == 0; }));
  EXPECT_EQ(done.back(), 4);
  EXPECT_LE(done.size(), 3U);
  EXPECT_GE(queue.status().lost, 4);
}

TEST(RetryQueue, TheNewestOfAKeyStays) {
  std::promise<void> answer;
  std::vector<int> done;
  {
    RetryQueue queue(10, kInterval, [] {});
    queue.push([&] { answer.get_future().wait(); });
    ASSERT_TRUE(waitFor([&] { return queue.status().waiting == 1; }));
    for (int k = 0; k < 5; ++k) queue.push([&done, k] { done.push_back(k); }, "result");
    answer.set_value();
  }  // what waits is done
  EXPECT_EQ(done.back(), 4);
  EXPECT_LE(done.size(), 2U) << "the first may have been taken already";
}

TEST(RetryQueue, EndsWhileTheDiskIsFull) {
  int tries = 0;
  {
    RetryQueue queue(10, std::chrono::hours(1), [] {});
    queue.push([&] {
      ++tries;
      throw FileError("the disk is full");
    });
    ASSERT_TRUE(waitFor([&] { return queue.status().failing; }));
  }
  EXPECT_EQ(tries, 2);
}

}  // namespace
}  // namespace uncertainty_identification
