#include "curves/beyond_differences.h"

#include <gtest/gtest.h>

#include <cmath>

#include "curves/held_out.h"
#include "support/first_order_windows.h"

namespace uncertainty_identification {
namespace {

/// A window's own gain and offset are no cause, and no fault of the model.
TEST(BeyondDifferences, ErrorsIgnoreGainAndOffset) {
  SimulationData held = firstOrderWindows(6, 100, 0.05, 6);
  const WindowFit fit = fitted(firstOrderWindows(20, 100, 0.05, 7));
  const double before = errorsBeyondDifferences(held, fit.model).sum();
  const double plain = heldOutErrors(held, fit.model).sum();
  for (SimulationWindow& window : held.windows) window.y = (1.3 * window.y.array() + 0.5).matrix();
  EXPECT_GT(heldOutErrors(held, fit.model).sum(), 5 * plain);
  EXPECT_LT(errorsBeyondDifferences(held, fit.model).sum(),
            2 * before);  // the noise has grown by 1.7
  EXPECT_GT(heldOutFit(held, errorsBeyondDifferences(held, fit.model)), 85);
}

/// What windows of one record differ by is no difference between records.
TEST(BeyondDifferences, WindowsOfARecordShareTheirGainAndOffset) {
  SimulationData held = firstOrderWindows(6, 100, 0.05, 6),
                 fit_to = firstOrderWindows(20, 100, 0.05, 7);
  for (std::size_t w = 0; w < 6; ++w) {
    held.windows[w].y.array() += w % 2 == 0 ? 0.3 : -0.3;
    held.windows[w].record = 0;
  }
  const WindowFit fit = fitted(fit_to);
  const double of_one_record = errorsBeyondDifferences(held, fit.model).sum();
  for (std::size_t w = 0; w < 6; ++w) held.windows[w].record = static_cast<int>(w);
  EXPECT_GT(of_one_record, 5 * errorsBeyondDifferences(held, fit.model).sum());

  for (std::size_t w = 0; w < 20; ++w) {
    fit_to.windows[w].y.array() += w % 2 == 0 ? 0.3 : -0.3;
    fit_to.windows[w].record = static_cast<int>(w) / 10;
  }
  const double of_two_records = leftOutBeyondDifferences(fit_to, fitted(fit_to)).sum();
  for (std::size_t w = 0; w < 20; ++w) fit_to.windows[w].record = static_cast<int>(w);
  EXPECT_GT(of_two_records, 2 * leftOutBeyondDifferences(fit_to, fitted(fit_to)).sum());
}

/// Windows that are left out may have a gain and an offset of their own as well.
TEST(BeyondDifferences, UnseenErrorsIgnoreGainAndOffset) {
  const SimulationData held = firstOrderWindows(6, 100, 0.05, 6);
  SimulationData alike = firstOrderWindows(20, 100, 0.05, 7), different = alike;
  for (std::size_t w = 0; w < 20; ++w) different.windows[w].y *= w % 2 == 0 ? 1.3 : 0.7;
  const WindowFit of_alike = fitted(alike), of_different = fitted(different);
  EXPECT_GT(of_different.left_out, 5 * of_alike.left_out);
  const Eigen::VectorXd beyond = unseenBeyondDifferences(different, of_different, held);
  ASSERT_EQ(beyond.size(), 26);
  EXPECT_EQ(beyond.tail(6), errorsBeyondDifferences(held, of_different.model));
  EXPECT_LT(beyond.head(20).sum(), 1.5 * of_alike.left_out);
}

/// The unseen windows of a few records show whether the records differ.
TEST(BeyondDifferences, SeveralRecordsOrFewWindowsBesideSeveralShowDifferences) {
  const auto of = [](const std::vector<int>& records) {
    SimulationData data;
    for (const int record : records) {
      data.windows.emplace_back();
      data.windows.back().record = record;
    }
    return data;
  };
  EXPECT_TRUE(showDifferences(of({0, 0}), of({0, 1})));
  EXPECT_TRUE(showDifferences(of({0, 1}), of({0, 0, 0})));
  EXPECT_FALSE(showDifferences(of({0, 1}), of({0, 0, 0, 0}))) << "one record has enough windows";
  EXPECT_FALSE(showDifferences(of({0, 0}), of({0, 0})));
}

TEST(BeyondDifferences, SingleStepsShowNothing) {
  SimulationData held = firstOrderWindows(4, 50, 0.05, 8);
  const WindowFit fit = fitted(firstOrderWindows(20, 100, 0.05, 7));
  for (SimulationWindow& window : held.windows) {
    window.u.setOnes();
    window.u.head(5).setZero();
  }
  EXPECT_EQ(errorsBeyondDifferences(held, fit.model).size(), 0);
}

/// Time constants that differ by the factor two are far outside the linear range.
TEST(BeyondDifferences, ErrorsIgnoreSpeed) {
  const WindowFit fit = fitted(firstOrderWindows(20, 100, 0.05, 7));
  const double alike = errorsBeyondDifferences(firstOrderWindows(6, 100, 0.05, 6), fit.model).sum();
  const SimulationData held = firstOrderWindows(
      6, 100, 0.05, 6, [](int w) { return std::pow(kPole, w % 2 == 0 ? 0.5 : 2); });
  EXPECT_GT(heldOutErrors(held, fit.model).sum(), 20 * alike);
  EXPECT_LT(errorsBeyondDifferences(held, fit.model).sum(), 1.3 * alike);

  const SimulationData data = firstOrderWindows(
      20, 100, 0.05, 7, [](int w) { return std::pow(kPole, w % 2 == 0 ? 0.7 : 1.5); });
  EXPECT_GT(fitted(data).left_out, 5 * alike);
  EXPECT_LT(leftOutBeyondDifferences(data, fitted(data)).sum() / 20, 1.3 * alike / 6);
}

TEST(BeyondDifferences, OneRecordHasOneSpeed) {
  SimulationData held = firstOrderWindows(
      6, 100, 0.05, 6, [](int w) { return std::pow(kPole, w % 2 == 0 ? 0.5 : 2); });
  const WindowFit fit = fitted(firstOrderWindows(20, 100, 0.05, 7));
  const double of_several = errorsBeyondDifferences(held, fit.model).sum();
  for (SimulationWindow& window : held.windows) window.record = 0;
  EXPECT_GT(errorsBeyondDifferences(held, fit.model).sum(), 5 * of_several);
}

}  // namespace
}  // namespace uncertainty_identification
