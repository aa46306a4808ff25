#include "explanation/residual_distribution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/fit_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// y(t) = u(t-1) + white noise of the given distribution, with its true model.
struct WithNoise {
  Fit fit;
  FitData data;
  Residuals residuals;
  ResidualDistribution distribution;
};

/// `pole` of the noise: 0 is white.
template <typename Draw>
WithNoise withNoise(const Draw& draw, double pole = 0, double wrong_readings = 0) {
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  std::vector<Experiment> experiments(20);
  for (Experiment& experiment : experiments) {
    experiment.sample_time = 1;
    experiment.u = VectorXd::NullaryExpr(200, [&] { return normal(engine); });
    experiment.y = VectorXd::NullaryExpr(200, [&] { return draw(&engine); });
    for (int t = 1; t < 200; ++t) experiment.y[t] += pole * experiment.y[t - 1];
    for (int t = 0; t < 200; ++t)
      if (std::bernoulli_distribution(wrong_readings)(engine))
        experiment.y[t] += 10 * normal(engine);
    experiment.y.tail(199) += experiment.u.head(199);
  }
  Configuration configuration = test::atRest(1, 0, 0, pole == 0 ? 0 : 1, 1);
  configuration.error_model.taps = 0;
  configuration.error_model.components = 1;
  dense::Model truth;
  truth.b = test::vectorOf({1});
  if (pole != 0) truth.d = test::vectorOf({-pole});
  truth.T = Eigen::MatrixXd(0, 0);
  const FitData data(experiments);
  const Fit fit = test::fitOfTruth(truth, configuration, data);
  const Residuals residuals = residualsOf(fit, data);
  return {fit, data, residuals, residualDistribution(fit, data, residuals)};
}

double gaussian(std::mt19937_64* engine) { return std::normal_distribution<double>()(*engine); }

double student(std::mt19937_64* engine) { return std::student_t_distribution<double>(4)(*engine); }

/// Gaussian noise of which one sample in fifty is ten times as large.
double contaminated(std::mt19937_64* engine) {
  return (std::bernoulli_distribution(0.02)(*engine) ? 10 : 1) * gaussian(engine);
}

TEST(ResidualDistributions, OfGaussianNoiseGainNothing) {
  const WithNoise of = withNoise(gaussian);
  // twice a gain is chi-squared with one or two degrees of freedom
  EXPECT_LT(of.distribution.student_gain, 6);
  EXPECT_LT(of.distribution.mixture_gain, 8);
  EXPECT_GT(of.distribution.clustering, 1e-3);
  int kept = 0;
  for (const Experiment& experiment : withoutOutliers(of.data, of.residuals, of.distribution))
    kept += experiment.validSamples();
  EXPECT_GE(kept, 3999);  // of 4000, beyond 4.5 deviations: 0.03
}

TEST(ResidualDistributions, OfStudentsNoiseAreStudents) {
  const WithNoise of = withNoise(student);
  EXPECT_GT(of.distribution.student_gain, 100);
  EXPECT_GE(of.distribution.degrees, 3.5);
  EXPECT_LE(of.distribution.degrees, 5);
  const VectorXd gain =
      distributionGain(of.distribution, DistributionFamily::student, of.residuals, of.data);
  EXPECT_NEAR(gain.sum(), of.distribution.student_gain, 0.02 * of.distribution.student_gain);
}

TEST(ResidualDistributions, OfWrongReadingsAreAMixture) {
  const WithNoise of = withNoise(contaminated);
  EXPECT_GT(of.distribution.mixture_gain, of.distribution.student_gain);
  EXPECT_NEAR(of.distribution.share, 0.02, 4 * std::sqrt(0.02 / 4000) + 0.005);
  EXPECT_NEAR(of.distribution.ratio, 10, 4 * 10 / std::sqrt(2 * 80.0));
  EXPECT_GT(of.distribution.clustering, 1e-6);
  const VectorXd gain =
      distributionGain(of.distribution, DistributionFamily::mixture, of.residuals, of.data);
  EXPECT_NEAR(gain.sum(), of.distribution.mixture_gain, 0.05 * of.distribution.mixture_gain);
  int masked = 0;
  for (const Experiment& experiment : withoutOutliers(of.data, of.residuals, of.distribution))
    masked += 200 - experiment.validSamples();
  EXPECT_GT(masked, 30);  // of 80 wide ones those beyond 4.5 deviations: 65 %
  EXPECT_LT(masked, 80);
}

/// Noise that remembers its past tells a load step from a wrong reading, white noise does not.
TEST(ResidualDistributions, TellReadingsFromDisturbancesThatLast) {
  EXPECT_TRUE(withNoise(contaminated).distribution.mayBeReadings());
  const ResidualDistribution lasting = withNoise(contaminated, 0.95).distribution;
  EXPECT_GT(lasting.mixture_gain, 100);
  EXPECT_FALSE(lasting.mayBeReadings());
  EXPECT_EQ(lasting.readingsGain(), 0);
  const ResidualDistribution readings = withNoise(gaussian, 0.95, 0.02).distribution;
  EXPECT_TRUE(readings.mayBeReadings());
  EXPECT_GT(readings.readingsGain(), 100);
}

TEST(ResidualDistributions, OfBurstsCluster) {
  int burst = 0;
  const WithNoise of = withNoise([&](std::mt19937_64* engine) {
    if (burst == 0 && std::bernoulli_distribution(0.005)(*engine)) burst = 5;
    if (burst > 0) --burst;
    return (burst > 0 ? 10 : 1) * gaussian(engine);
  });
  EXPECT_LT(of.distribution.clustering, 1e-6);
}

}  // namespace
}  // namespace uncertainty_identification
