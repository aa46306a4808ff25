#include "model/shared_signal.h"

#include <gtest/gtest.h>

#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

using test::vectorOf;

TEST(DecayOf, IsWhereTheResponseHasVanishedWithinRounding) {
  // 0.9^t = 1e-17 at t = 371.5; (t + 1) 0.9^t is largest at t = 8 to 9 and vanishes at 425
  EXPECT_EQ(decayOf({vectorOf({-0.9})}, 10000), 372);
  EXPECT_NEAR(decayOf({vectorOf({-0.9}), vectorOf({-0.9})}, 10000), 417, 15);
  EXPECT_EQ(decayOf({vectorOf({-0.9})}, 100), 100);
  EXPECT_EQ(decayOf({vectorOf({-1.0})}, 1000), 1000);
  EXPECT_EQ(decayOf({}, 1000), 1);
  EXPECT_EQ(decayOf({vectorOf({})}, 1000), 1);
  EXPECT_EQ(decayOf({vectorOf({0, 0, -0.5})}, 1000), 3 * 56 + 1);  // 0.5^56 = 1.4e-17
}

TEST(DecayOf, WaitsForResponsesThatGrowAgain) {
  // two slow poles behind a fast one: the response is small in the first samples only
  const int decay = decayOf({vectorOf({-0.2}), vectorOf({-1.98, 0.9801})}, 100000);
  EXPECT_GT(decay, 3000);
  EXPECT_LT(decay, 6000);
}

}  // namespace
}  // namespace uncertainty_identification
