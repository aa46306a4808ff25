// The recursive estimate against the batch one: after all samples of an experiment both must know
// the same. Data: the paper's Example 1 in small, simulated.
#include "detection/error_filter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/example1.h"
#include "support/faults.h"
#include "uncertainty_identification/identifier.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

TEST(ErrorFilter, EndsAtLikelihoodResponsibilitiesAndMeansOfTheExperiments) {
  const auto experiments = example1Experiments(6);
  Configuration configuration = example1Configuration();
  configuration.estimation.max_iterations = 3;
  configuration.estimation.threads = 1;
  const Estimate estimate = Identifier(configuration).identify(experiments);
  const NominalModelEstimate& go = estimate.nominal_model;
  const RationalBasis basis{ErrorBasis(estimate.error_model.options)};
  for (std::size_t r = 0; r < experiments.size(); ++r) {
    WhitenedStream stream(streamModel({go.delay, go.b, go.a, go.c, go.d}, basis),
                          configuration.estimation, 0, 0);
    ErrorFilter filter(estimate.error_model.mixture, 0, 0, estimate.noise_variance.value);
    double log_likelihood = 0;
    for (int t = 0; t < experiments[r].samples(); ++t) {
      const VectorXd& found = stream.step(experiments[r].u[t], experiments[r].y[t]);
      WhitenedObservation observation;
      observation.residual = found[0];
      observation.regressors = found.tail(1);
      log_likelihood += filter.update(observation).log_density;
    }
    const ExperimentEstimate& expected = estimate.experiments[r];
    EXPECT_NEAR(log_likelihood, expected.log_likelihood, 1e-8 * std::abs(log_likelihood));
    EXPECT_NEAR(filter.errorMean()[0], expected.error_mean[0], 1e-8);
    for (std::size_t i = 0; i < expected.responsibilities.size(); ++i)
      EXPECT_NEAR(filter.probabilities()[i], expected.responsibilities[i], 1e-8);
  }
}

/// A mixture of two points, one sample: the score is known by hand.
TEST(ErrorFilter, ScoresByThePredictiveDistribution) {
  Mixture mixture{{0.5, 0.5},
                  {VectorXd::Constant(1, -2), VectorXd::Constant(1, 2)},
                  {Eigen::MatrixXd::Zero(1, 1), Eigen::MatrixXd::Zero(1, 1)}};
  WhitenedObservation observation;
  observation.regressors = VectorXd::Ones(1);
  observation.residual = 0;  // the median
  ErrorFilter filter(mixture, 0, 0, 1.0);
  const Score score = filter.update(observation);
  EXPECT_NEAR(score.value, 0, 1e-12);
  EXPECT_NEAR(score.deviation, std::sqrt(1 + 4.0), 1e-12);
  EXPECT_NEAR(score.log_density, -0.5 * std::log(2 * M_PI) - 2, 1e-12);
  EXPECT_NEAR(filter.probabilities()[0], 0.5, 1e-12);

  observation.residual = -2;  // P = 1/2 (1/2 + 1 - Q(-4)) = 0.25 + 1.6e-5: quantile of the normal
  EXPECT_NEAR(ErrorFilter(mixture, 0, 0, 1.0).update(observation).value, -0.674440, 1e-5);
  observation.residual = 60;  // beyond the doubles in both tails
  EXPECT_GT(ErrorFilter(mixture, 0, 0, 1.0).update(observation).value, 30);
  observation.residual = -60;
  EXPECT_LT(ErrorFilter(mixture, 0, 0, 1.0).update(observation).value, -30);
}

/// e = 1000 c + omega: before the first sample nothing is known about c.
TEST(ErrorFilter, ASampleThatDeterminesADiffuseCoefficientIsNoScore) {
  WhitenedObservation observation;
  observation.regressors = VectorXd(0);
  observation.columns = VectorXd::Constant(1, 1000);
  observation.residual = 5000;
  ErrorFilter filter(Mixture(), 0, 1, 0.01);
  EXPECT_TRUE(filter.update(observation).diffuse);
  observation.residual = 5000.1;
  const Score second = filter.update(observation);
  EXPECT_FALSE(second.diffuse);
  EXPECT_NEAR(second.value, 0.1 / std::sqrt(0.02), 1e-6);  // variance 2 sigma^2
}

/// theta = theta_hat + z, e = -z + omega with z ~ N(0, 1): the prediction's variance is 1 +
/// sigma^2.
TEST(ErrorFilter, ErrorsOfTheParametersWidenThePrediction) {
  WhitenedObservation observation;
  observation.regressors = VectorXd(0);
  observation.residual_derivative = VectorXd::Constant(1, 1.0);
  observation.regressor_derivatives = Eigen::MatrixXd(1, 0);
  observation.residual = 2;
  ErrorFilter filter(Mixture(), 1, 0, 0.25);
  const Score first = filter.update(observation);
  EXPECT_NEAR(first.value, 2 / std::sqrt(1.25), 1e-12);
  const Score second = filter.update(observation);  // z is now 1.6 with variance 0.2
  EXPECT_NEAR(second.value, 0.4 / std::sqrt(0.45), 1e-12);
}

}  // namespace
}  // namespace uncertainty_identification
