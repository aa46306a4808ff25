// The area of the region of the Bode diagram that contains 95 % of the plants.
#include "explanation/bode_area.h"

#include <gtest/gtest.h>

#include <cmath>

namespace uncertainty_identification {
namespace {

/// b q^-1/(1 + a q^-1) with a gain that spreads by the relative `deviation`.
Fit spread(double a, double deviation) {
  NominalModelOptions plant;
  plant.structure = Structure::output_error;
  plant.nb = plant.na = 1;
  plant.delay = 1;
  ErrorModelOptions error;
  error.taps = 1;
  error.constraint = Constraint::free;
  Fit fit;
  fit.model =
      std::make_shared<const ExtendedModel>(makeNominalModel(plant, 1), ErrorBasis(error),
                                            EstimationOptions(), Effects(), DataSummary(), 1);
  fit.at.parameters = Eigen::Vector2d(2, a);
  fit.at.mixture.weights = {1};
  fit.at.mixture.means = {Eigen::VectorXd::Zero(1)};
  fit.at.mixture.covariances = {Eigen::MatrixXd::Constant(1, 1, deviation * deviation)};
  return fit;
}

TEST(BodeArea, OfAGainThatSpreadsIsTheRatioOfItsQuantiles) {
  const double quantile = 1.959964;
  for (const double deviation : {0.02, 0.1, 0.3}) {
    const double expected = 3 * std::log10((1 + quantile * deviation) / (1 - quantile * deviation));
    // 1,000 draws: their 2.5 % quantiles have a standard error of 6 % at most, less by stratifying
    EXPECT_NEAR(bodeArea(spread(-0.5, deviation)), expected, 0.05 * expected) << deviation;
  }
}

TEST(BodeArea, DoesNotExistWithoutStability) {
  EXPECT_TRUE(std::isnan(bodeArea(spread(-1.1, 0.1))));
}

}  // namespace
}  // namespace uncertainty_identification
