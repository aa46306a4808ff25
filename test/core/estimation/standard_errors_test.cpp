#include "estimation/standard_errors.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

bool mentions(const std::string& text, const std::string& word) {
  return text.find(word) != std::string::npos;
}

struct Maximum {
  Maximum(const Configuration& configuration, const std::vector<Experiment>& experiments,
          const ModelParameters& start)
      : setup(configuration, experiments) {
    const OptimisationOptions options =
        test::optimisationOptions(configuration, start.mixture, 1e-8);
    at = maximumLikelihood(setup.likelihood(), start, options).point;
    const Index n = setup.model().regressors();
    const Parametrisation parametrisation(setup.model(), options.constraint,
                                          at.mixture.components(), MatrixXd::Zero(n, n));
    names = parametrisation.naturalNames();
    errors = standardErrors(setup.likelihood(), parametrisation, at);
  }

  double errorOf(const std::string& name) const {
    const auto k = std::find(names.begin(), names.end(), name) - names.begin();
    return std::sqrt(errors.covariance(k, k));
  }

  test::CoreSetup setup;
  ModelParameters at;
  std::vector<std::string> names;
  StandardErrors errors;
};

/// y = b u + omega: the errors of linear regression.
TEST(StandardErrors, OfARegressionAreKnown) {
  test::RandomSystemOptions options;
  options.na = options.nc = options.nd = options.taps = 0;
  options.experiments = 60;
  const auto system = test::randomSystem(options, 3);
  const Maximum top(test::configurationOf(options), system.experiments,
                    test::parametersOf(system.truth));
  double power = 0, samples = 0;
  for (const Experiment& experiment : system.experiments) {
    power += experiment.u.head(experiment.samples() - 1).squaredNorm();
    samples += experiment.samples();
  }
  const double variance = top.at.noise_variance;
  EXPECT_NEAR(top.errorOf("b1"), std::sqrt(variance / power), 1e-6 * std::sqrt(variance / power));
  EXPECT_NEAR(top.errorOf("noise_variance"), variance * std::sqrt(2 / samples),
              1e-5 * variance * std::sqrt(2 / samples));
  EXPECT_TRUE(top.errors.singular.empty());
  // the model is true, so the sandwich agrees up to the noise of 60 scores
  const VectorXd ratio =
      top.errors.robust_covariance.diagonal().cwiseQuotient(top.errors.covariance.diagonal());
  EXPECT_LT((ratio.head(1).array() - 1).abs().maxCoeff(), 0.6);
}

/// The sandwich notices that experiments differ more than the model says.
TEST(StandardErrors, RobustOnesNoticeAWrongModel) {
  test::RandomSystemOptions options;
  options.na = options.nc = options.nd = 0;
  options.zero_static_gain = false;
  options.taps = 1;
  options.experiments = 60;
  const auto system = test::randomSystem(options, 3);
  options.taps = 0;  // the spread of the gain is left out
  Configuration configuration = test::configurationOf(options);
  ModelParameters start = test::parametersOf(system.truth);
  start.mixture = {{1.0}, {VectorXd(0)}, {MatrixXd(0, 0)}};
  const Maximum top(configuration, system.experiments, start);
  EXPECT_GT(top.errors.robust_covariance(0, 0), 4 * top.errors.covariance(0, 0));
}

TEST(StandardErrors, OfWeightsAndMeansOfSeparateComponents) {
  test::RandomSystemOptions options;
  options.experiments = 200;
  auto system = test::randomSystem(options, 3);
  system.truth.noise_variance = 1e-3;
  system.truth.mixture = {{0.3, 0.7},
                          {VectorXd::Constant(1, -2), VectorXd::Constant(1, 2)},
                          {MatrixXd::Constant(1, 1, 0.2), MatrixXd::Constant(1, 1, 0.1)}};
  const double gain = system.truth.b[0];
  ASSERT_GT(std::abs(gain), 0.4);
  system = test::simulateSystem(system.truth, options, 4);
  const Maximum top(test::configurationOf(options), system.experiments,
                    test::parametersOf(system.truth));
  // xi is all but observed: binomial, sample mean and sample variance
  const Mixture& mixture = top.at.mixture;
  const double weight = mixture.weights[0], members = 200 * weight;
  const double spread = mixture.covariances[0](0, 0);
  EXPECT_NEAR(top.errorOf("weight1"), std::sqrt(weight * (1 - weight) / 200), 2e-4);
  EXPECT_NEAR(top.errorOf("weight2"), top.errorOf("weight1"), 1e-9);
  EXPECT_NEAR(top.errorOf("mean1[1]"), std::sqrt(spread / members),
              0.02 * std::sqrt(spread / members));
  EXPECT_NEAR(top.errorOf("covariance1[1,1]"), spread * std::sqrt(2 / members),
              0.02 * spread * std::sqrt(2 / members));
  const MatrixXd& covariance = top.errors.covariance;
  EXPECT_LT((covariance - covariance.transpose()).norm(), 1e-12 * covariance.norm());
}

class Unidentifiable : public testing::TestWithParam<int> {};

/// With the tap q^0 and a free static gain, the gain of Go and the mixture trade off exactly.
TEST_P(Unidentifiable, GainAndMixtureAreNamed) {
  test::RandomSystemOptions options;
  options.taps = 1;
  options.zero_static_gain = false;
  options.components = GetParam();
  options.experiments = 40;
  const auto system = test::randomSystem(options, 7);
  const Maximum top(test::configurationOf(options), system.experiments,
                    test::parametersOf(system.truth));
  ASSERT_EQ(top.errors.singular.size(), 1u);
  const std::string& sentence = top.errors.singular[0];
  EXPECT_TRUE(mentions(sentence, "b1")) << sentence;
  EXPECT_TRUE(mentions(sentence, "cannot be told apart")) << sentence;
  EXPECT_TRUE(std::isnan(top.errorOf("b1")));
  for (int i = 1; i <= GetParam(); ++i) {
    const std::string mean = "mean" + std::to_string(i) + "[1]";
    EXPECT_TRUE(mentions(sentence, mean)) << sentence;
    EXPECT_TRUE(std::isnan(top.errorOf(mean)));
  }
  for (const char* name : {"a1", "c1", "d1", "noise_variance"}) {
    EXPECT_FALSE(mentions(sentence, name)) << sentence;
    EXPECT_GT(top.errorOf(name), 0) << name << " is well determined";
  }
}

INSTANTIATE_TEST_SUITE_P(Components, Unidentifiable, testing::Values(1, 2));

/// The same data under a constraint that fixes the gain.
TEST(StandardErrors, ZeroMeanRemovesTheSingularity) {
  test::RandomSystemOptions options;
  options.taps = 1;
  options.zero_static_gain = false;
  options.components = 1;
  options.experiments = 40;
  const auto system = test::randomSystem(options, 7);
  Configuration configuration = test::configurationOf(options);
  configuration.error_model.constraint = Constraint::zero_mean;
  ModelParameters start = test::parametersOf(system.truth);
  start.mixture.means[0].setZero();
  const Maximum top(configuration, system.experiments, start);
  EXPECT_TRUE(top.errors.singular.empty());
  EXPECT_GT(top.errorOf("b1"), 0);
}

StandardErrors errorsAtTruth(const test::RandomSystemOptions& options,
                             const test::RandomSystem& system) {
  const test::CoreSetup setup(test::configurationOf(options), system.experiments);
  const Parametrisation parametrisation(setup.model(), Constraint::free, 1, MatrixXd(0, 0));
  return standardErrors(setup.likelihood(), parametrisation, test::parametersOf(system.truth));
}

/// Neighbouring samples of a smooth input are nearly the same, so that the information of the
/// numerator's coefficients is nearly singular. They are determined all the same, as linear
/// regression shows.
TEST(StandardErrors, OfANumeratorBehindASmoothInputAreKnown) {
  test::RandomSystemOptions options;
  options.nb = 4;
  options.na = options.nc = options.nd = options.taps = 0;
  auto system = test::randomSystem(options, 7);
  MatrixXd regressors(0, 4);
  for (Experiment& experiment : system.experiments) {
    const VectorXd rough = experiment.u;
    experiment.u[0] = 0;
    for (int pass = 0; pass < 6; ++pass)
      for (Index t = 1; t < experiment.u.size(); ++t)
        experiment.u[t] = 0.9 * experiment.u[t - 1] + 0.1 * experiment.u[t];
    for (Index t = 0; t < experiment.u.size(); ++t) {
      regressors.conservativeResize(regressors.rows() + 1, 4);
      for (Index k = 0; k < 4; ++k) {
        regressors(regressors.rows() - 1, k) = t > k ? experiment.u[t - 1 - k] : 0;
        if (t > k)
          experiment.y[t] += system.truth.b[k] * (experiment.u[t - 1 - k] - rough[t - 1 - k]);
      }
    }
  }
  const MatrixXd r =
      regressors.householderQr().matrixQR().topRows(4).triangularView<Eigen::Upper>();
  const MatrixXd inverse = r.inverse();
  const StandardErrors errors = errorsAtTruth(options, system);
  EXPECT_TRUE(errors.singular.empty());
  for (Index k = 0; k < 4; ++k) {
    const double expected = std::sqrt(system.truth.noise_variance) * inverse.row(k).norm();
    EXPECT_NEAR(std::sqrt(errors.covariance(k, k)), expected, 0.01 * expected) << k;
  }
}

/// An input that moves only just before the end shows b1 but never b2.
TEST(StandardErrors, NameAParameterThatIsNotExcited) {
  test::RandomSystemOptions options;
  options.nb = 2;
  options.na = options.nc = options.nd = options.taps = 0;
  auto system = test::randomSystem(options, 7);
  for (Experiment& experiment : system.experiments) {
    const Eigen::Index last = experiment.u.size() - 1;
    experiment.u.setZero();
    experiment.u[last - 1] = 3;
    experiment.y[last] = system.truth.b[0] * 3;
  }
  const StandardErrors errors = errorsAtTruth(options, system);
  ASSERT_EQ(errors.singular.size(), 1u);
  EXPECT_EQ(errors.singular[0].find("b2 cannot be determined"), 0u) << errors.singular[0];
  EXPECT_TRUE(std::isnan(errors.covariance(1, 1)));
  EXPECT_TRUE(std::isnan(errors.robust_covariance(1, 1)));
  EXPECT_GT(errors.covariance(0, 0), 0);
}

/// A constant input shows the sum of b1, b2 and b3 alone, and leaves two directions undetermined.
TEST(StandardErrors, NameParametersOfSeveralDirectionsOnce) {
  test::RandomSystemOptions options;
  options.nb = 3;
  options.na = options.nc = options.nd = options.taps = 0;
  auto system = test::randomSystem(options, 7);
  for (Experiment& experiment : system.experiments) {
    experiment.u.setOnes();
    experiment.valid.assign(static_cast<std::size_t>(experiment.samples()), 1);
    std::fill_n(experiment.valid.begin(), 4, std::uint8_t{0});
  }
  const StandardErrors errors = errorsAtTruth(options, system);
  ASSERT_EQ(errors.singular.size(), 1u);
  EXPECT_EQ(errors.singular[0].find("b1, b2 and b3 cannot be told apart"), 0u)
      << errors.singular[0];
}

}  // namespace
}  // namespace uncertainty_identification
