#include "inspection/held_signal.h"

#include <gtest/gtest.h>

namespace uncertainty_identification {
namespace {

std::vector<double> heldValues(const StampedSignal& signal, double start, double period,
                               Eigen::Index count) {
  const Eigen::VectorXd held = heldSignal(signal, start, period, count);
  return {held.data(), held.data() + held.size()};
}

using Values = std::vector<double>;

TEST(HeldSignal, OnItsOwnGridIsTheSignal) {
  EXPECT_EQ(heldValues({{5, 5.5, 6}, {1, 2, 3}}, 5, 0.5, 3), (Values{1, 2, 3}));
}

TEST(HeldSignal, HoldsTheNewestValueUntilTheNext) {
  EXPECT_EQ(heldValues({{0, 2.5, 4}, {1, 2, 3}}, 0, 1, 6), (Values{1, 1, 1, 2, 3, 3}));
}

TEST(HeldSignal, TakesTheNewestOfSeveralWithinAPeriod) {
  EXPECT_EQ(heldValues({{0, 0.2, 0.6, 0.9, 1.4}, {1, 2, 3, 4, 5}}, 0, 1, 3), (Values{1, 4, 5}));
}

TEST(HeldSignal, BeforeItsFirstValueIsTheFirst) {
  EXPECT_EQ(heldValues({{2, 3}, {7, 8}}, -1, 1, 5), (Values{7, 7, 7, 7, 8}));
}

TEST(HeldSignal, CountsAStampThatIsLateByRoundingOnly) {
  EXPECT_EQ(heldValues({{0, 1.0005}, {1, 2}}, 0, 1, 2), (Values{1, 2}));
  EXPECT_EQ(heldValues({{0, 1.002}, {1, 2}}, 0, 1, 3), (Values{1, 1, 2}));
  EXPECT_EQ(heldValues({{0, 0.010005}, {1, 2}}, 0, 0.01, 2), (Values{1, 2}))
      << "measured in periods";
}

TEST(HeldSignal, KeepsStepWithStampsSince1970) {
  StampedSignal signal;
  for (int k = 0; k < 1000; ++k) {
    signal.stamps.push_back(1.7e9 + 0.01 * k);
    signal.values.push_back(k);
  }
  EXPECT_EQ(heldValues(signal, 1.7e9, 0.01, 1000), signal.values);
}

}  // namespace
}  // namespace uncertainty_identification
