#include "data/stamped_buffer.h"

#include <gtest/gtest.h>

namespace uncertainty_identification {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

StampedBuffer upTo(int count) {
  StampedBuffer buffer;
  for (int stamp = 0; stamp < count; ++stamp) buffer.push(stamp, 10 * stamp);
  return buffer;
}

TEST(StampedBuffer, FindsStamps) {
  const StampedBuffer buffer = upTo(5);
  EXPECT_EQ(buffer.newest(), 4);
  EXPECT_EQ(buffer.oldest(), 0);
  EXPECT_EQ(buffer.firstFrom(2), 2);
  EXPECT_EQ(buffer.firstFrom(2.5), 3);
  EXPECT_EQ(buffer.firstFrom(5), kEndless);
  EXPECT_EQ(buffer.firstAbove(2), 3);
  EXPECT_EQ(buffer.firstAbove(4), kEndless);
  EXPECT_EQ(buffer.stampAfter(1, 2), 3);  // 1 and 2, then 3
  EXPECT_EQ(buffer.stampAfter(1, 3), 4);
  EXPECT_EQ(buffer.stampAfter(1, 4), kEndless);
}

TEST(StampedBuffer, CopiesHalfOpenSpans) {
  const StampedBuffer buffer = upTo(6);
  int duplicates = 0;
  EXPECT_EQ(buffer.copy(1.5, 4, false, duplicates).stamps, (std::vector<double>{2, 3}));
  EXPECT_EQ(buffer.copy(1.5, 4, true, duplicates).stamps, (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(buffer.copy(2, 4, true, duplicates).values, (std::vector<double>{20, 30}));
  EXPECT_EQ(buffer.copy(9, 10, true, duplicates).stamps, (std::vector<double>{5}));
  EXPECT_TRUE(buffer.copy(9, 10, false, duplicates).stamps.empty());
}

TEST(StampedBuffer, CountsDuplicatesWithTheSampleTheyRepeat) {
  StampedBuffer buffer = upTo(3);
  EXPECT_FALSE(buffer.push(2, 99));
  EXPECT_TRUE(buffer.push(3, 30));
  int duplicates = 0;
  buffer.copy(0, 2, false, duplicates);
  EXPECT_EQ(duplicates, 0);
  EXPECT_EQ(buffer.copy(2, 4, false, duplicates).values, (std::vector<double>{20, 30}));
  EXPECT_EQ(duplicates, 1);
}

TEST(StampedBuffer, ForgetsWhatIsNotNeeded) {
  StampedBuffer buffer = upTo(6);
  buffer.forgetBefore(2.5, true);
  EXPECT_EQ(buffer.oldest(), 2);
  buffer.forgetBefore(4, true);
  EXPECT_EQ(buffer.oldest(), 4);  // in force at the start, nothing older is needed
  buffer.forgetBefore(4.5, false);
  EXPECT_EQ(buffer.size(), 1u);
  buffer.forgetBefore(100, true);
  EXPECT_EQ(buffer.size(), 1u);
  buffer.forgetAllBut(0);
  EXPECT_EQ(buffer.size(), 0u);
  EXPECT_EQ(buffer.newest(), 5);
  buffer.clear();
  EXPECT_EQ(buffer.newest(), StampedBuffer::kNever);
}

}  // namespace
}  // namespace uncertainty_identification
