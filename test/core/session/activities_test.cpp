#include "session/activities.h"

#include <gtest/gtest.h>

namespace uncertainty_identification {
namespace {

TEST(Activities, NamesWhatRunsAndSinceWhen) {
  double now = 10;
  int changes = 0;
  Activities activities([&] { return now; }, [&] { ++changes; });
  EXPECT_TRUE(activities.running().empty());
  auto first = activities.begin("first");
  now = 12;
  const auto second = activities.begin("second");
  ASSERT_EQ(activities.running().size(), 2U);
  EXPECT_EQ(activities.running()[0].what, "first");
  EXPECT_EQ(activities.running()[0].since, 10);
  EXPECT_EQ(activities.running()[1].since, 12);
  first.reset();
  ASSERT_EQ(activities.running().size(), 1U);
  EXPECT_EQ(activities.running()[0].what, "second");
  EXPECT_EQ(changes, 3);
}

}  // namespace
}  // namespace uncertainty_identification
