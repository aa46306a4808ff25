// Fits of extended models to data.
#include "explanation/fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/effect_setup.h"

namespace uncertainty_identification {
namespace {

/// A fit without a likelihood has no posterior means to be linearised about.
TEST(Relinearised, LeavesAFitWithoutLikelihoodAsItIs) {
  const test::EffectSetup setup;
  const FitData data(setup.experiments());
  for (const char* name : {"plant_cubic", "exp_clock"}) {
    const std::shared_ptr<const ExtendedModel> model = setup.extended({{name, ""}});
    ModelParameters at = setup.at(test::noticeable(*model->effects().front()));
    at.parameters[1] = std::nan("");
    const Fit failed = evaluated(model, at, data);
    ASSERT_FALSE(std::isfinite(failed.log_likelihood));
    const Fit again = relinearised(failed, data);
    EXPECT_FALSE(std::isfinite(again.log_likelihood));
    EXPECT_EQ(again.model, failed.model);
  }
}

TEST(Relinearised, StandsAtThePosteriorMeans) {
  const test::EffectSetup setup;
  const FitData data(setup.experiments());
  const std::shared_ptr<const ExtendedModel> model = setup.extended({{"plant_cubic", ""}});
  Fit fit = evaluated(model, setup.at(test::noticeable(*model->effects().front())), data);
  for (int round = 0; round < 8; ++round) fit = relinearised(fit, data);
  ASSERT_TRUE(std::isfinite(fit.log_likelihood));
  EXPECT_LT((fit.model->currentPoints() - fit.xi).cwiseAbs().maxCoeff(), 1e-4);
}

}  // namespace
}  // namespace uncertainty_identification
