#include "session/work_queue.h"

#include <gtest/gtest.h>

#include <thread>

namespace uncertainty_identification {
namespace {

TEST(WorkQueue, HandsOutAllThatWaitsInOrder) {
  WorkQueue<int> queue;
  queue.push(1);
  queue.push(2);
  EXPECT_EQ(queue.takeAll(), (std::vector<int>{1, 2}));
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
}

TEST(WorkQueue, ClosingEndsTheWaiting) {
  WorkQueue<int> queue;
  std::thread consumer([&queue] { EXPECT_TRUE(queue.takeAll().empty()); });
  queue.close();
  consumer.join();
}

TEST(WorkQueue, WhatIsLeftWhenItClosesIsHandedOut) {
  WorkQueue<int> queue;
  queue.push(1);
  queue.close();
  EXPECT_EQ(queue.takeAll(), std::vector<int>{1});
  EXPECT_TRUE(queue.takeAll().empty());
}

}  // namespace
}  // namespace uncertainty_identification
