#include "configuration/thread_count.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "uncertainty_identification/configuration.h"

namespace uncertainty_identification {
namespace {

TEST(ThreadCount, LeavesOneCoreUntilAllAreUsed) {
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  EXPECT_EQ(threadCount(3), 3);
  EXPECT_EQ(threadCount(kAutomatic), std::max(1, cores - 1));
  useAllCores();
  EXPECT_EQ(threadCount(kAutomatic), cores);
  EXPECT_EQ(threadCount(3), 3);
}

}  // namespace
}  // namespace uncertainty_identification
