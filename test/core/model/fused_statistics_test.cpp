// Compares the fused sweep with the generic path through evaluate(), which must give the same
// result.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>

#include "model/model.h"
#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

/// The same model without its fused statistics.
class Generic : public Model {
 public:
  explicit Generic(const Model& of) : of_(of) {}
  std::vector<std::string> names() const override { return of_.names(); }
  int regressors() const override { return of_.regressors(); }
  void evaluate(const Block& block, const VectorXd& parameters, bool derivatives,
                Response* response) const override {
    of_.evaluate(block, parameters, derivatives, response);
  }
  bool admissible(const VectorXd& parameters) const override { return of_.admissible(parameters); }
  VectorXd toUnbounded(const VectorXd& parameters) const override {
    return of_.toUnbounded(parameters);
  }
  VectorXd fromUnbounded(const VectorXd& unbounded) const override {
    return of_.fromUnbounded(unbounded);
  }
  Eigen::MatrixXd unboundedJacobian(const VectorXd& unbounded) const override {
    return of_.unboundedJacobian(unbounded);
  }

 private:
  const Model& of_;
};

Statistics statisticsOf(const Model& model, const std::vector<Block>& blocks, int experiments,
                        const VectorXd& parameters, bool derivatives) {
  Statistics statistics(experiments, model.regressors(), derivatives ? model.parameterCount() : 0);
  Response response;
  for (const Block& block : blocks)
    computeStatistics(model, block, parameters, &statistics, &response);
  return statistics;
}

void expectSame(const Statistics& one, const Statistics& other, const std::string& what) {
  EXPECT_EQ(one.samples(), other.samples()) << what;
  EXPECT_EQ(one.logJacobian(), other.logJacobian()) << what;
  if (one.parameters() > 0) {
    EXPECT_EQ(one.logJacobianDerivatives(), other.logJacobianDerivatives()) << what;
  }
  // Sums may cancel in one experiment, so the tolerance is relative to their size in all
  // experiments.
  VectorXd scale = VectorXd::Zero(one.parameters() + 1);
  for (int r = 0; r < one.experiments(); ++r) {
    scale[0] = std::max(scale[0], other.gram(r).norm());
    for (int j = 0; j < one.parameters(); ++j) {
      scale[j + 1] = std::max(scale[j + 1], other.gramDerivative(r, j).norm());
    }
  }
  for (int r = 0; r < one.experiments(); ++r) {
    EXPECT_LE((one.gram(r) - other.gram(r)).norm(), 1e-11 * scale[0]) << what << ", " << r;
    for (int j = 0; j < one.parameters(); ++j) {
      EXPECT_LE((one.gramDerivative(r, j) - other.gramDerivative(r, j)).norm(),
                1e-11 * scale[j + 1])
          << what << ", experiment " << r << ", parameter " << j;
    }
  }
}

class FusedStatistics : public testing::TestWithParam<int> {};

TEST_P(FusedStatistics, EqualTheGenericOnes) {
  const int order = GetParam();
  for (int taps : {0, 2, 3}) {
    for (int delay : {0, 1, 3}) {
      test::RandomSystemOptions options;
      options.nb = order;
      options.na = delay == 1 ? order : order - 1;
      options.nc = delay == 0 ? order : 1;
      options.nd = delay == 3 ? order : 0;
      options.delay = delay;
      options.taps = taps;
      options.pole_radius = 0.8;
      options.experiments = 13;  // a full block and a part of one
      options.min_samples = 2;
      const auto system = test::randomSystem(options, 5);
      const test::CoreSetup setup(test::configurationOf(options), system.experiments);
      const VectorXd at = test::parametersOf(system.truth).parameters;
      Statistics fused(13, setup.model().regressors(), setup.model().parameterCount());
      ASSERT_TRUE(setup.model().fusedStatistics(setup.blocks()[0], at, true, &fused));
      ASSERT_TRUE(setup.blocks()[1].ragged);
      const Generic generic(setup.model());
      for (bool derivatives : {true, false}) {
        const std::string what = "order " + std::to_string(order) + ", taps " +
                                 std::to_string(taps) + ", delay " + std::to_string(delay);
        expectSame(statisticsOf(setup.model(), setup.blocks(), 13, at, derivatives),
                   statisticsOf(generic, setup.blocks(), 13, at, derivatives), what);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Orders, FusedStatistics, testing::Values(1, 2, 3, 4));

class FusedStructures : public testing::TestWithParam<Structure> {};

TEST_P(FusedStructures, EqualTheGenericOnes) {
  test::RandomSystemOptions options;
  options.na = 2;
  const auto system = test::randomSystem(options, 6);
  Configuration configuration = test::configurationOf(options);
  configuration.nominal_model.structure = GetParam();
  const test::CoreSetup setup(configuration, system.experiments);
  const VectorXd at =
      setup.model().fromUnbounded(VectorXd::Constant(setup.model().parameterCount(), 0.3));
  Statistics fused(20, 1, setup.model().parameterCount());
  ASSERT_TRUE(setup.model().fusedStatistics(setup.blocks()[0], at, true, &fused));
  expectSame(statisticsOf(setup.model(), setup.blocks(), 20, at, true),
             statisticsOf(Generic(setup.model()), setup.blocks(), 20, at, true), "");
}

INSTANTIATE_TEST_SUITE_P(Structures, FusedStructures,
                         testing::Values(Structure::output_error, Structure::arx, Structure::armax,
                                         Structure::box_jenkins, Structure::continuous));

/// The sweep must decline what it does not support.
TEST(FusedStatisticsLimits, AreRefusedWhereTheyWouldBeWrong) {
  test::RandomSystemOptions options;
  options.missing = 0.1;
  const auto gaps = test::randomSystem(options, 6);
  options.missing = 0;
  const auto whole = test::randomSystem(options, 6);
  const auto fused = [&](const Configuration& configuration,
                         const std::vector<Experiment>& experiments) {
    const test::CoreSetup setup(configuration, experiments);
    const VectorXd at =
        setup.model().fromUnbounded(VectorXd::Constant(setup.model().parameterCount(), 0.3));
    Statistics statistics(20, setup.model().regressors(), 0);
    return setup.model().fusedStatistics(setup.blocks()[0], at, false, &statistics);
  };
  const Configuration plain = test::configurationOf(options);
  EXPECT_TRUE(fused(plain, whole.experiments));
  EXPECT_FALSE(fused(plain, gaps.experiments));
  const auto changed = [&](const std::function<void(Configuration&)>& change) {
    Configuration configuration = plain;
    change(configuration);
    return fused(configuration, whole.experiments);
  };
  EXPECT_FALSE(
      changed([](Configuration& c) { c.estimation.initial_state = InitialState::estimate; }));
  EXPECT_FALSE(
      changed([](Configuration& c) { c.estimation.initial_state = InitialState::discard; }));
  EXPECT_FALSE(changed([](Configuration& c) { c.estimation.offsets = Offsets::estimate; }));
  EXPECT_FALSE(changed([](Configuration& c) { c.estimation.offsets = Offsets::per_experiment; }));
  EXPECT_FALSE(
      changed([](Configuration& c) { c.estimation.noise_start = NoiseStart::stationary; }));
  EXPECT_FALSE(changed([](Configuration& c) { c.error_model.basis = BasisKind::laguerre; }));
  EXPECT_FALSE(changed([](Configuration& c) { c.error_model.taps = 4; }));
  EXPECT_FALSE(changed([](Configuration& c) { c.nominal_model.na = 5; }));
}

}  // namespace
}  // namespace uncertainty_identification
