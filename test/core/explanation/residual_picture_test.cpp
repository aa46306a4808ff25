// What explanations contain for the figures of residuals.
#include <gtest/gtest.h>

#include <cmath>

#include "support/example1.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

constexpr double kDeadZone = 0.4;

/// Commands are held for eight samples, so that the output correlates with the present command.
const Explanation& explanation() {
  static const Explanation kExplanation = [] {
    Truth truth = loadTruth(std::string(PROJECT_FOLDER) + "/config/example1_truth.yaml");
    truth.experiments = 30;
    truth.input.kind = InputKind::steps;
    truth.input.hold = 8;
    std::vector<Experiment> experiments = simulate(truth, 1);
    for (Experiment& experiment : experiments) experiment.u += kDeadZone * experiment.u.cwiseSign();
    return explain(example1Configuration(), experiments);
  }();
  return kExplanation;
}

TEST(ResidualPicture, NothingIsLeftWithTheCause) {
  const ResidualPicture& after = explanation().residual_after;
  ASSERT_EQ(after.autocorrelation.size(), 20u);
  ASSERT_EQ(after.cross_correlation.size(), 21u);
  // 21 experiments of 100 samples, Gaussian: four standard deviations
  EXPECT_NEAR(after.confidence_95, 1.96 / std::sqrt(2100), 1e-12);
  for (const double correlation : after.autocorrelation)
    EXPECT_LT(std::abs(correlation), 4 / std::sqrt(2100.0));
  for (const double correlation : after.cross_correlation)
    EXPECT_LT(std::abs(correlation), 4 / std::sqrt(2100.0));
  EXPECT_NEAR(after.variance_of_time.mean(), 1, 0.1);
}

TEST(ResidualPicture, ShowsTheDeadZoneOverTheInput) {
  const ResidualPicture &before = explanation().residual_before,
                        &after = explanation().residual_after;
  ASSERT_GT(before.input_level.size(), 5);
  ASSERT_EQ(before.input_level.size(), before.residual_of_input.size());
  EXPECT_LT(before.input_level.minCoeff(), -kDeadZone);
  EXPECT_GT(before.input_level.maxCoeff(), kDeadZone);
  EXPECT_GT(before.residual_of_input.norm(), 2 * after.residual_of_input.norm());
}

TEST(ResidualPicture, SpectraAndBinsHaveTheirAxes) {
  for (const ResidualPicture* picture :
       {&explanation().residual_before, &explanation().residual_after}) {
    ASSERT_EQ(picture->frequency.size(), picture->spectrum.size());
    ASSERT_GT(picture->frequency.size(), 20);
    EXPECT_GT(picture->frequency[0], 0);
    EXPECT_LE(picture->frequency[picture->frequency.size() - 1], M_PI / 0.01 * (1 + 1e-12));
    for (Eigen::Index k = 1; k < picture->frequency.size(); ++k)
      EXPECT_GT(picture->frequency[k], picture->frequency[k - 1]);
    EXPECT_EQ(picture->time.size(), 20);
    EXPECT_NEAR(picture->time[0], 0.025, 1e-12);  // 100 samples of 0.01 s in 20 bins
    EXPECT_EQ(picture->of_experiment.size(), 21u);
  }
}

}  // namespace
}  // namespace uncertainty_identification
