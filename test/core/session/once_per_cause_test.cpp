#include "session/once_per_cause.h"

#include <gtest/gtest.h>

namespace uncertainty_identification {
namespace {

TEST(OncePerCause, NumbersAndExperimentsMakeNoOtherCause) {
  OncePerCause causes;
  EXPECT_TRUE(causes.isNew("experiment 'a': the clock went back by 1.5e-3 s"));
  EXPECT_FALSE(causes.isNew("experiment 'b': the clock went back by 20 s"));
  EXPECT_FALSE(causes.isNew("experiment '': the clock went back by -inf s"));
  EXPECT_TRUE(causes.isNew("experiment 'a': the clock stood still for 20 s"));
}

TEST(OncePerCause, TopicsDo) {
  OncePerCause causes;
  EXPECT_TRUE(causes.isNew("topic '/motor1' has no header, sample 12"));
  EXPECT_TRUE(causes.isNew("topic '/motor2' has no header, sample 12"));
  EXPECT_FALSE(causes.isNew("topic '/motor2' has no header, sample 13"));
  causes.forget();
  EXPECT_TRUE(causes.isNew("topic '/motor2' has no header, sample 13"));
}

TEST(OncePerCause, AtMostAHundredAreRemembered) {
  OncePerCause causes;
  int told = 0;
  for (int k = 0; k < 300; ++k) told += causes.isNew(std::string(k, 'x')) ? 1 : 0;
  EXPECT_EQ(told, 100);
}

}  // namespace
}  // namespace uncertainty_identification
