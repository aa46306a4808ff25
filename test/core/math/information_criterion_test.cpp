#include "math/information_criterion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace uncertainty_identification {
namespace {

TEST(Bic, CountsSamplesForTheModelAndExperimentsForTheMixture) {
  EXPECT_NEAR(bic(-100, 5, 3, 2000, 40), 200 + 5 * std::log(2000.0) + 3 * std::log(40.0), 1e-12);
}

TEST(Bic, PenaltyIsHalfOfWhatAParameterAddsToTheCriterion) {
  EXPECT_NEAR(bicPenalty(3, 2000), 1.5 * std::log(2000.0), 1e-12);
  EXPECT_EQ(bic(0, 3, 0, 2000, 1), 2 * bicPenalty(3, 2000));
}

}  // namespace
}  // namespace uncertainty_identification
