#include "curves/search_time.h"

#include <gtest/gtest.h>

namespace uncertainty_identification {
namespace {

TEST(SearchTime, EndsAtAShareOfTheLimitAndLaterWhereASearchConfirms) {
  SimulationSearchOptions options;
  options.time_limit = 1e-9;
  SearchTime time(options);
  const CurveSearchContext context = time.context(nullptr);
  while (time.seconds() < 1e-3) {
  }
  EXPECT_FALSE(context.going_on());
  options.time_limit = 2 * time.seconds() + 100;
  EXPECT_TRUE(context.going_on());
  time.allow(1e-12);
  EXPECT_FALSE(context.going_on());
  time.allow(1);
  options.time_limit = 0.75 * time.seconds();
  time.setPurpose(Purpose::confirming);
  EXPECT_TRUE(context.going_on()) << "a third of twice the limit is left";
  time.setPurpose(Purpose::looking);
  EXPECT_FALSE(context.going_on());
  time.setPurpose(Purpose::confirming);
  time.allow(0.99);
  EXPECT_FALSE(context.going_on()) << "a part of the limit has no more for that";
}

TEST(SearchTime, HasNoLimitWhereNoneIsStated) {
  const SimulationSearchOptions options;
  SearchTime time(options);
  time.allow(0);
  EXPECT_TRUE(time.context(nullptr).going_on());
}

TEST(SearchTime, TellsWhatIsDoneAndStaysCancelled) {
  SimulationSearchOptions options;
  std::string told;
  bool goes_on = true;
  options.progress = [&](const std::string& doing) {
    told = doing;
    return goes_on;
  };
  SearchTime time(options);
  const CurveSearchContext context = time.context(nullptr);
  context.tell("comparing curves");
  EXPECT_TRUE(context.going_on());
  EXPECT_EQ(told, "comparing curves");
  goes_on = false;
  EXPECT_FALSE(context.going_on());
  goes_on = true;
  EXPECT_FALSE(context.going_on());
}

}  // namespace
}  // namespace uncertainty_identification
