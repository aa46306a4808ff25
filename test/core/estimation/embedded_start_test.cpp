#include "estimation/embedded_start.h"

#include <gtest/gtest.h>

#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

test::RandomSystemOptions options() {
  test::RandomSystemOptions of;
  of.nb = 2;
  of.na = 1;
  of.nc = of.nd = 0;
  of.components = 2;
  of.experiments = 30;
  of.min_samples = of.max_samples = 200;
  of.noise_variance = 0.1;
  return of;
}

/// Go = (q^-1 + 0.5 q^-2)/(1 - 0.7 q^-1) with errors in two clusters, most of them far from 0.
test::RandomSystem clustered() {
  dense::Model truth = test::randomSystem(options(), 1).truth;
  truth.b = test::vectorOf({1, 0.5});
  truth.a = test::vectorOf({-0.7});
  truth.mixture = {{0.85, 0.15},
                   {test::vectorOf({0.9}), test::vectorOf({-0.9})},
                   {MatrixXd::Constant(1, 1, 0.01), MatrixXd::Constant(1, 1, 0.01)}};
  return test::simulateSystem(truth, options(), 5);
}

Polynomials sizes() { return {1, VectorXd::Zero(2), VectorXd::Zero(1), {}, {}}; }

ErrorBasis basis() { return ErrorBasis(test::configurationOf(options()).error_model); }

/// A fit pooled over all experiments includes the mean error in Go. The numerators of single
/// experiments tell them apart.
TEST(EmbeddedStart, FindsGoWhereThePooledFitDoesNot) {
  const test::RandomSystem system = clustered();
  const LeastSquaresModel pooled =
      LeastSquaresStart(test::pointersTo(system.experiments), Constant::none)
          .steiglitzMcBride(2, 1, 1, 1);
  const auto starts = embeddedStarts(basis(), sizes(), system.experiments, false);
  ASSERT_FALSE(starts.empty());
  EXPECT_LE(starts.size(), 2u);
  EXPECT_GT((pooled.polynomials.b - system.truth.b).norm(), 0.3);
  EXPECT_LT((starts[0].polynomials.b - system.truth.b).norm(), 0.03);
  EXPECT_NEAR(starts[0].polynomials.a[0], -0.7, 0.01);
}

TEST(EmbeddedStart, ConstantsAreTakenOut) {
  test::RandomSystem system = clustered();
  for (Experiment& experiment : system.experiments) experiment.y.array() += 20;
  const auto starts = embeddedStarts(basis(), sizes(), system.experiments, true);
  ASSERT_FALSE(starts.empty());
  EXPECT_LT((starts[0].polynomials.b - system.truth.b).norm(), 0.03);
}

TEST(EmbeddedStart, SaysNothingWhereItCannotKnow) {
  test::RandomSystem system = clustered();
  ErrorModelOptions laguerre = test::configurationOf(options()).error_model;
  laguerre.basis = BasisKind::laguerre;
  laguerre.pole = 0.5;
  EXPECT_TRUE(embeddedStarts(ErrorBasis(laguerre), sizes(), system.experiments, false).empty());
  ErrorModelOptions none = test::configurationOf(options()).error_model;
  none.taps = 0;
  EXPECT_TRUE(embeddedStarts(ErrorBasis(none), sizes(), system.experiments, false).empty());
  const std::vector<Experiment> two(system.experiments.begin(), system.experiments.begin() + 2);
  EXPECT_TRUE(embeddedStarts(basis(), sizes(), two, false).empty());
  for (std::size_t r = 2; r < system.experiments.size(); ++r) {
    system.experiments[r].valid.assign(200, 1);
    system.experiments[r].valid[50] = 0;
  }
  EXPECT_TRUE(embeddedStarts(basis(), sizes(), system.experiments, false).empty())
      << "experiments with missing outputs are not used";
}

}  // namespace
}  // namespace uncertainty_identification
