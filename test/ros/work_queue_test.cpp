#include "uncertainty_identification/ros/work_queue.h"

#include <gtest/gtest.h>

#include <thread>

namespace uncertainty_identification {
namespace {

TEST(WorkQueue, HandsOutAllThatWaitsInOrder) {
  WorkQueue<int> queue;
  queue.push(1);
  queue.push(2);
  EXPECT_EQ(queue.size(), 2U);
  EXPECT_EQ(queue.takeAll(), (std::vector<int>{1, 2}));
  EXPECT_EQ(queue.size(), 0U);
}

TEST(WorkQueue, NothingIsLostBetweenThreads) {
  WorkQueue<int> queue;
  constexpr int kCount = 20000;
  std::vector<std::thread> producers;
  for (int producer = 0; producer < 4; ++producer)
    producers.emplace_back([&queue] {
      for (int i = 0; i < kCount; ++i) queue.push(i);
    });
  std::size_t received = 0;
  while (received < 4 * kCount) received += queue.takeAll().size();
  for (auto& producer : producers) producer.join();
  EXPECT_EQ(received, 4U * kCount);
  EXPECT_EQ(queue.size(), 0U);
}

TEST(WorkQueue, ClosingEndsTheWaiting) {
  WorkQueue<int> queue;
  std::thread consumer([&queue] { EXPECT_TRUE(queue.takeAll().empty()); });
  queue.close();
  consumer.join();
  queue.push(1);
  EXPECT_TRUE(queue.takeAll().empty());
}

TEST(WorkQueue, ClearingForgetsWhatWaits) {
  WorkQueue<int> queue;
  queue.push(1);
  queue.clear();
  queue.push(2);
  EXPECT_EQ(queue.takeAll(), std::vector<int>{2});
}

}  // namespace
}  // namespace uncertainty_identification
