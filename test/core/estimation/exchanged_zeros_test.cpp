// Zeros of B and of the mean of 1 + GDelta change places without a change of the mean system.
#include "estimation/exchanged_zeros.h"

#include <gtest/gtest.h>

#include "math/polynomial.h"
#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;
using test::vectorOf;

/// B times the mean of 1 + GDelta.
VectorXd meanNumerator(const LinearModel& model, const ModelParameters& at) {
  VectorXd error = model.basis().T() * at.mixture.mean();
  error[0] += 1;
  const Polynomials p = model.nominal().polynomials(at.parameters);
  return product(p.b, error);
}

test::CoreSetup setupOf(int nb, int taps, Constraint constraint) {
  Configuration configuration = test::atRest(nb, 1, 1, 1, 1);
  configuration.error_model.taps = taps;
  configuration.error_model.constraint = constraint;
  test::RandomSystemOptions options;
  options.experiments = 2;
  return test::CoreSetup(configuration, test::randomSystem(options, 1).experiments);
}

ModelParameters pointOf(const VectorXd& theta, const VectorXd& mean) {
  const Eigen::Index n = mean.size();
  return {theta, {{1.0}, {mean}, {0.04 * Eigen::MatrixXd::Identity(n, n)}}, 0.1};
}

TEST(ExchangedZeros, KeepTheMeanSystem) {
  const auto setup = setupOf(2, 3, Constraint::zero_static_gain);
  const ModelParameters at = pointOf(vectorOf({1.0, 0.3, -0.5, 0.2, -0.4}), vectorOf({0.2, 0.5}));
  const auto exchanged = withExchangedZeros(setup.model(), at, Constraint::zero_static_gain);
  ASSERT_EQ(exchanged.size(), 2u) << "either zero of the error model with the one of B";
  for (const ModelParameters& point : exchanged) {
    EXPECT_GT((point.parameters - at.parameters).norm(), 0.1);
    EXPECT_EQ(point.parameters.tail(3), at.parameters.tail(3)) << "A, C and D stay";
    EXPECT_LT((meanNumerator(setup.model(), point) - meanNumerator(setup.model(), at)).norm(),
              1e-9);
    EXPECT_EQ(withExchangedZeros(setup.model(), point, Constraint::zero_static_gain).size(), 2u);
  }
}

TEST(ExchangedZeros, AComplexPairStaysTogether) {
  const auto setup = setupOf(2, 3, Constraint::zero_static_gain);
  // the mean of 1 + GDelta is 1.2 - 0.9 q^-1 + 0.7 q^-2, whose zeros are complex
  const ModelParameters at = pointOf(vectorOf({1.0, 0.3, -0.5, 0.2, -0.4}), vectorOf({0.2, -0.9}));
  EXPECT_TRUE(withExchangedZeros(setup.model(), at, Constraint::zero_static_gain).empty());
}

TEST(ExchangedZeros, AreNoneWhereNothingCanBeExchanged) {
  const auto no_zero = setupOf(1, 2, Constraint::zero_static_gain);
  EXPECT_TRUE(withExchangedZeros(no_zero.model(),
                                 pointOf(vectorOf({1.0, -0.5, 0.2, -0.4}), vectorOf({0.2})),
                                 Constraint::zero_static_gain)
                  .empty());
  const auto zero_mean = setupOf(2, 2, Constraint::zero_mean);
  EXPECT_TRUE(withExchangedZeros(zero_mean.model(),
                                 pointOf(vectorOf({1.0, 0.3, -0.5, 0.2, -0.4}), vectorOf({0, 0})),
                                 Constraint::zero_mean)
                  .empty());
}

}  // namespace
}  // namespace uncertainty_identification
