// Compares the fused sweep with the general path through evaluate(), which must give the same
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

/// By the general path.
Statistics generic(const test::CoreSetup& setup, const VectorXd& parameters, bool derivatives) {
  const Model& model = setup.model();
  Statistics statistics(setup.likelihood().experiments(), model.regressors(),
                        derivatives ? model.parameterCount() : 0);
  Response response;
  for (const Block& block : setup.blocks())
    computeStatistics(model, block, parameters, &statistics, &response);
  return statistics;
}

/// By the fused sweep; whether it took all blocks.
bool fused(const test::CoreSetup& setup, const VectorXd& parameters, Statistics* statistics) {
  const auto sweep =
      setup.model().prepare(setup.blocks(), parameters, statistics->parameters() > 0);
  return sweep != nullptr &&
         std::all_of(setup.blocks().begin(), setup.blocks().end(),
                     [&](const Block& block) { return sweep->statistics(block, statistics); });
}

Statistics fused(const test::CoreSetup& setup, const VectorXd& parameters, bool derivatives) {
  const Model& model = setup.model();
  Statistics statistics(setup.likelihood().experiments(), model.regressors(),
                        derivatives ? model.parameterCount() : 0);
  EXPECT_TRUE(fused(setup, parameters, &statistics));
  return statistics;
}

void expectSame(const Statistics& one, const Statistics& other, const std::string& what,
                double tolerance = 1e-11) {
  EXPECT_EQ(one.samples(), other.samples()) << what;
  const int experiments = one.experiments();
  const auto compare = [&](const auto& of, const std::string& name, double scale) {
    double largest = 0;
    for (int r = 0; r < experiments; ++r) {
      const Eigen::MatrixXd expected = of(other, r);
      scale = std::max(scale, expected.norm());
      largest = std::max(largest, (of(one, r) - expected).norm());
    }
    EXPECT_LE(largest, tolerance * scale) << what << ": " << name;
  };
  compare([](const Statistics& s, int r) { return Eigen::MatrixXd(s.gram(r)); }, "gram", 0);
  compare([](const Statistics& s, int r) { return s.logJacobian().segment(r, 1); }, "logJacobian",
          1);
  // The derivative of a log-determinant holds an inverse, which multiplies rounding errors. These
  // depend on the instructions that the processor has.
  constexpr double kOfInverse = 10;
  for (int j = 0; j < one.parameters(); ++j) {
    const std::string of_j = " derivative to parameter " + std::to_string(j);
    compare([j](const Statistics& s, int r) { return Eigen::MatrixXd(s.gramDerivative(r, j)); },
            "gram," + of_j, 0);
    compare(
        [j](const Statistics& s, int r) { return s.logJacobianDerivatives().block(j, r, 1, 1); },
        "logJacobian," + of_j, kOfInverse);
  }
}

/// What the options of a case change of everything at rest without offsets.
struct Nuisances {
  std::string name;
  InitialState initial_state = InitialState::zero;
  NoiseStart noise_start = NoiseStart::zero;
  Offsets offsets = Offsets::none;
  double precision = 1e-3;
  /// Relative, for ordinary and for slow poles. The rounding of sums, unless columns are nearly
  /// dependent (a constant and the response of a slow pole) and no prior regularises them: then
  /// both methods lose digits.
  double tolerance = 1e-11, of_slow_poles = 1e-11;
};

void apply(const Nuisances& nuisances, EstimationOptions* options) {
  options->initial_state = nuisances.initial_state;
  options->noise_start = nuisances.noise_start;
  options->offsets = nuisances.offsets;
  options->initial_precision = nuisances.precision;
}

class FusedStatistics : public testing::TestWithParam<Nuisances> {};

/// Random systems of all shapes; 13 experiments are a full block and a part of one.
TEST_P(FusedStatistics, EqualTheGenericOnes) {
  std::uint64_t seed = 5;
  for (int order : {1, 2, 3, 4}) {
    for (int taps : {0, 2, 3, 4}) {
      for (int delay : {0, 1, 3, 5}) {
        test::RandomSystemOptions options;
        options.nb = order;
        options.na = delay == 1 ? order : order - 1;
        options.nc = delay == 0 ? order : 1;
        options.nd = delay == 3 ? order : (delay == 5 ? 2 : 0);
        options.delay = delay;
        options.taps = taps;
        options.zero_static_gain = taps != 3;
        options.pole_radius = 0.8;
        options.experiments = 13;
        options.min_samples = delay == 3 ? 2 : 60;
        options.max_samples = delay == 0 ? 60 : 100;
        const auto system = test::randomSystem(options, ++seed);
        Configuration configuration = test::configurationOf(options);
        apply(GetParam(), &configuration.estimation);
        const test::CoreSetup setup(configuration, system.experiments);
        VectorXd at = test::parametersOf(system.truth).parameters;
        if (GetParam().offsets == Offsets::estimate) at = test::appended(at, 0.7);
        for (bool derivatives : {true, false}) {
          const std::string what = "order " + std::to_string(order) + ", taps " +
                                   std::to_string(taps) + ", delay " + std::to_string(delay);
          expectSame(fused(setup, at, derivatives), generic(setup, at, derivatives), what,
                     GetParam().tolerance);
        }
      }
    }
  }
}

/// Columns that do not decay within the record, in records of equal and of different length.
TEST_P(FusedStatistics, EqualTheGenericOnesWithSlowPoles) {
  for (const int shortest : {120, 300}) {
    test::RandomSystemOptions options;
    options.na = 2;
    options.nd = 2;
    options.delay = 2;
    options.experiments = 11;
    options.min_samples = shortest;
    options.max_samples = 300;
    const auto system = test::randomSystem(options, 3);
    Configuration configuration = test::configurationOf(options);
    apply(GetParam(), &configuration.estimation);
    const test::CoreSetup setup(configuration, system.experiments);
    VectorXd at = test::parametersOf(system.truth).parameters;
    at.segment(1, 2) << -1.899, 0.8991;  // roots 0.999 and 0.9
    at.segment(3, 1) << 0.5;
    at.segment(4, 2) << -1.299, 0.2997;  // roots 0.999 and 0.3
    if (GetParam().offsets == Offsets::estimate) at = test::appended(at, 0.7);
    expectSame(fused(setup, at, true), generic(setup, at, true), std::to_string(shortest),
               GetParam().of_slow_poles);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Nuisances, FusedStatistics,
    testing::Values(Nuisances{"atRest"}, Nuisances{"commonOffset", {}, {}, Offsets::estimate},
                    Nuisances{"ownOffsets", {}, {}, Offsets::per_experiment},
                    Nuisances{"unknownState", InitialState::estimate},
                    Nuisances{"stationaryNoise", InitialState::zero, NoiseStart::stationary},
                    Nuisances{"defaults", InitialState::estimate, NoiseStart::stationary,
                              Offsets::estimate},
                    Nuisances{"allColumns", InitialState::estimate, NoiseStart::stationary,
                              Offsets::per_experiment, 1e-3, 1e-11, 1e-10},
                    Nuisances{"flatPrior", InitialState::estimate, NoiseStart::stationary,
                              Offsets::per_experiment, 0, 1e-10, 1e-8}),
    [](const testing::TestParamInfo<Nuisances>& info) { return info.param.name; });

class FusedStructures : public testing::TestWithParam<Structure> {};

TEST_P(FusedStructures, EqualTheGenericOnes) {
  test::RandomSystemOptions options;
  options.na = 2;
  const auto system = test::randomSystem(options, 6);
  Configuration configuration = test::configurationOf(options);
  configuration.nominal_model.structure = GetParam();
  configuration.estimation = EstimationOptions();
  const test::CoreSetup setup(configuration, system.experiments);
  const VectorXd at =
      setup.model().fromUnbounded(VectorXd::Constant(setup.model().parameterCount(), 0.3));
  expectSame(fused(setup, at, true), generic(setup, at, true), "");
}

INSTANTIATE_TEST_SUITE_P(Structures, FusedStructures,
                         testing::Values(Structure::output_error, Structure::arx, Structure::armax,
                                         Structure::box_jenkins, Structure::continuous));

/// A model without its fused sweep.
class General : public LinearModel {
 public:
  explicit General(const LinearModel& of, const EstimationOptions& options,
                   const NominalModelOptions& nominal)
      : LinearModel(makeNominalModel(nominal, 1), of.basis(), options) {}
  std::unique_ptr<const FusedSweep> prepare(const std::vector<Block>& /*blocks*/,
                                            const VectorXd& /*parameters*/,
                                            bool /*derivatives*/) const override {
    return nullptr;
  }
};

/// The general path whitens by a time-varying gain, whose derivative differs from that of columns
/// for the initial noise: both are Gauss-Newton matrices, equal where the noise starts from rest.
TEST(FusedInformation, EqualsTheGenericOne) {
  for (const bool stationary : {false, true}) {
    for (const auto offsets : {Offsets::none, Offsets::estimate, Offsets::per_experiment}) {
      test::RandomSystemOptions options;
      options.na = options.nd = 2;
      options.taps = 3;
      options.delay = 2;
      options.experiments = 13;
      const auto system = test::randomSystem(options, 8);
      Configuration configuration = test::configurationOf(options);
      apply({"", InitialState::estimate, stationary ? NoiseStart::stationary : NoiseStart::zero,
             offsets},
            &configuration.estimation);
      const test::CoreSetup setup(configuration, system.experiments);
      ModelParameters at = test::parametersOf(system.truth);
      if (offsets == Offsets::estimate) at.parameters = test::appended(at.parameters, 0.7);
      const Likelihood& likelihood = setup.likelihood();
      const LatentMoments moments =
          latentMoments(likelihood.expect(likelihood.statistics(at.parameters, false), at));
      const General general(setup.model(), configuration.estimation, configuration.nominal_model);
      const auto expected = Likelihood(general, setup.blocks(), 13, 1).information(at, moments);
      const auto found = likelihood.information(at, moments);
      const double tolerance = stationary ? 0.05 : 1e-11;
      const VectorXd scale = expected.complete.diagonal().cwiseSqrt().cwiseInverse();
      const auto scaled = [&](const Eigen::MatrixXd& difference) {
        return (scale.asDiagonal() * difference * scale.asDiagonal()).eval().cwiseAbs().maxCoeff();
      };
      EXPECT_LE(scaled(found.complete - expected.complete), tolerance) << static_cast<int>(offsets);
      EXPECT_LE(scaled(found.observed - expected.observed), tolerance) << static_cast<int>(offsets);
    }
  }
}

/// The selection of orders also fits high orders without error model.
TEST(FusedHighOrders, EqualTheGenericOnes) {
  for (int order : {6, 8}) {
    test::RandomSystemOptions options;
    options.nb = options.na = options.nc = options.nd = order;
    options.taps = 0;
    options.pole_radius = 0.7;
    const auto system = test::randomSystem(options, 6);
    Configuration configuration = test::configurationOf(options);
    configuration.estimation = EstimationOptions();
    const test::CoreSetup setup(configuration, system.experiments);
    const VectorXd at = test::appended(test::parametersOf(system.truth).parameters, 0.7);
    expectSame(fused(setup, at, true), generic(setup, at, true), std::to_string(order));
  }
}

/// The sweep must decline what it does not support.
TEST(FusedStatisticsLimits, AreRefusedWhereTheyWouldBeWrong) {
  test::RandomSystemOptions options;
  options.missing = 0.1;
  const auto gaps = test::randomSystem(options, 6);
  options.missing = 0;
  const auto whole = test::randomSystem(options, 6);
  const auto takes = [&](const Configuration& configuration,
                         const std::vector<Experiment>& experiments) {
    const test::CoreSetup setup(configuration, experiments);
    const VectorXd at =
        setup.model().fromUnbounded(VectorXd::Constant(setup.model().parameterCount(), 0.3));
    Statistics statistics(20, setup.model().regressors(), 0);
    return fused(setup, at, &statistics);
  };
  const Configuration plain = test::configurationOf(options);
  EXPECT_TRUE(takes(plain, whole.experiments));
  EXPECT_FALSE(takes(plain, gaps.experiments));
  const auto changed = [&](const std::function<void(Configuration&)>& change) {
    Configuration configuration = plain;
    change(configuration);
    return takes(configuration, whole.experiments);
  };
  EXPECT_FALSE(
      changed([](Configuration& c) { c.estimation.initial_state = InitialState::discard; }));
  EXPECT_FALSE(changed([](Configuration& c) {
    c.estimation.offsets = Offsets::estimate;
    c.estimation.offset_side = OffsetSide::input;
  }));
  EXPECT_FALSE(changed([](Configuration& c) {
    c.estimation.offsets = Offsets::per_experiment;
    c.estimation.offset_side = OffsetSide::input;
  }));
  EXPECT_FALSE(changed([](Configuration& c) { c.error_model.basis = BasisKind::laguerre; }));
}

}  // namespace
}  // namespace uncertainty_identification
