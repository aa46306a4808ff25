#include "curves/covariate_signals.h"

#include <gtest/gtest.h>

#include <cmath>

namespace uncertainty_identification {
namespace {

/// A heater that is switched on at the third sample.
Experiment switched() {
  Experiment experiment;
  experiment.id = "switched";
  experiment.sample_time = 0.5;
  experiment.u = experiment.y = Eigen::VectorXd::Zero(40);
  Eigen::VectorXd heater = Eigen::VectorXd::Zero(40);
  heater.tail(38).setConstant(10);
  experiment.signals["heater"] = heater;
  return experiment;
}

TEST(CovariateSignals, AreThereBehindLagsIfThereIsAUnit) {
  const std::vector<Experiment> fitted{switched()};
  EXPECT_EQ(covariateScales(fitted, {}, 0).size(), 1u);
  const auto scales = covariateScales(fitted, {}, 0.5);
  ASSERT_EQ(scales.size(), 9u);  // itself, and 1 to 128 s
  const CovariateScale& lagged = scales.at("heater behind a lag of 4 s");
  EXPECT_EQ(lagged.of, "heater");
  EXPECT_DOUBLE_EQ(lagged.lag, 4);
  EXPECT_LT(lagged.offset, scales.at("heater").offset);
}

TEST(CovariateSignals, FollowTheCovariateWithTheTimeConstantOfTheLag) {
  CovariateScale covariate;
  covariate.of = "heater";
  EXPECT_DOUBLE_EQ(signalOf(covariate, switched())[2], 10);
  covariate.lag = 4;
  const Eigen::VectorXd signal = signalOf(covariate, switched());
  for (int k = 0; k < 40; ++k)
    EXPECT_NEAR(signal[k], k < 3 ? 0 : 10 * (1 - std::exp(-0.5 * (k - 2) / 4.0)), 1e-12) << k;
  Experiment constant = switched();
  constant.signals.clear();
  constant.scalars["heater"] = 7;
  EXPECT_DOUBLE_EQ(signalOf(covariate, constant)[39], 7) << "it had been constant before";
}

}  // namespace
}  // namespace uncertainty_identification
