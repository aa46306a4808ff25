#include "curves/curve_search.h"

#include <gtest/gtest.h>

namespace uncertainty_identification {
namespace {

constexpr double kShare = 0.03;

/// A search that ended with so many causes, and with this error of left-out windows; the plant
/// without causes leaves 600.
CurveSearchResult endedWith(std::size_t causes, double left_out, double held_error = 1) {
  CurveSearchResult result;
  result.base.left_out = 600;
  result.causes.resize(causes);
  result.fit.left_out = left_out;
  result.held_error = held_error;
  return result;
}

bool better(const CurveSearchResult& other, const CurveSearchResult& than) {
  return isBetter(other, than, kShare);
}

TEST(IsBetter, AskedForATenthLessWithAsManyCauses) {
  EXPECT_TRUE(better(endedWith(1, 89), endedWith(1, 100)));
  EXPECT_FALSE(better(endedWith(1, 91), endedWith(1, 100)));
}

TEST(IsBetter, WithFewerCausesWhereItLeavesAboutAsMuch) {
  EXPECT_TRUE(better(endedWith(0, 109), endedWith(1, 100)));
  EXPECT_FALSE(better(endedWith(0, 111), endedWith(1, 100)));
}

TEST(IsBetter, WithMoreCausesOnlyIfTheyExplainAShareOfTheWhole) {
  EXPECT_TRUE(better(endedWith(2, 69), endedWith(1, 100)));
  EXPECT_FALSE(better(endedWith(2, 71), endedWith(1, 100)));
  EXPECT_FALSE(better(endedWith(3, 0.3), endedWith(1, 3))) << "of 600, one cause leaves 3";
}

TEST(IsBetter, NotWhereHeldOutWindowsLose) {
  EXPECT_FALSE(better(endedWith(1, 10, 1.06), endedWith(1, 100)));
}

}  // namespace
}  // namespace uncertainty_identification
