#include "model/linear_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/core_setup.h"

namespace uncertainty_identification {
namespace {

using Eigen::VectorXd;

test::RandomSystem drawn() {
  test::RandomSystemOptions options;
  options.nb = options.na = 2;
  options.experiments = 3;
  return test::randomSystem(options, 2);
}

Configuration configuration(Offsets offsets, OffsetSide side) {
  Configuration made = test::atRest(2, 2, 1, 1, 1);
  made.estimation.offsets = offsets;
  made.estimation.offset_side = side;
  return made;
}

TEST(LinearModel, ACommonOffsetIsItsLastParameter) {
  const auto system = drawn();
  const auto names = [&](Offsets offsets, OffsetSide side) {
    return test::CoreSetup(configuration(offsets, side), system.experiments).model().names();
  };
  EXPECT_EQ(names(Offsets::none, OffsetSide::output).size(), 6u);
  EXPECT_EQ(names(Offsets::per_experiment, OffsetSide::output).size(), 6u);
  EXPECT_EQ(names(Offsets::estimate, OffsetSide::output).back(), "offset_y");
  EXPECT_EQ(names(Offsets::estimate, OffsetSide::input).back(), "offset_u");
}

TEST(LinearModel, SimulatesTheNominalModelWithItsOffset) {
  const auto system = drawn();
  const VectorXd theta = test::parametersOf(system.truth).parameters;
  for (OffsetSide side : {OffsetSide::output, OffsetSide::input}) {
    const test::CoreSetup setup(configuration(Offsets::estimate, side), system.experiments);
    const Block& block = setup.blocks()[0];
    const Signals found = setup.model().simulate(block, test::appended(theta, 0.8));
    for (int lane = 0; lane < block.lanes; ++lane) {
      const Experiment& experiment = *block.experiments[static_cast<std::size_t>(lane)];
      const dense::Matrix go = dense::toeplitz(dense::impulseResponse(
          system.truth.b, dense::monic(system.truth.a), system.truth.delay, experiment.samples()));
      const double before = side == OffsetSide::input ? 0.8 : 0, after = 0.8 - before;
      const VectorXd u = experiment.u.array() + before;
      const VectorXd expected = (go * u.cast<dense::Real>()).cast<double>().array() + after;
      const VectorXd one = found.row(lane).head(experiment.samples()).matrix().transpose();
      EXPECT_LT((one - expected).norm(), 1e-11 * expected.norm());
    }
  }
}

TEST(LinearModel, UnboundedCoordinatesPassTheOffsetOn) {
  const auto system = drawn();
  const test::CoreSetup setup(configuration(Offsets::estimate, OffsetSide::output),
                              system.experiments);
  const LinearModel& model = setup.model();
  const VectorXd z = 0.5 * VectorXd::Random(7), at = model.fromUnbounded(z);
  EXPECT_EQ(at[6], z[6]);
  EXPECT_LT((model.toUnbounded(at) - z).norm(), 1e-13);
  const auto back = [&](const VectorXd& x) { return model.fromUnbounded(x); };
  EXPECT_LT((model.unboundedJacobian(z) - test::differences(back, z)).norm(), 1e-9);
  EXPECT_TRUE(model.admissible(at));
  EXPECT_FALSE(model.admissible(test::appended(at.head(6), std::nan(""))));
}

TEST(LinearModel, RespondsWithOneDerivativePerParameter) {
  const auto system = drawn();
  Configuration all = configuration(Offsets::estimate, OffsetSide::output);
  all.estimation.initial_state = InitialState::estimate;
  const test::CoreSetup setup(all, system.experiments);
  const VectorXd at = test::appended(test::parametersOf(system.truth).parameters, 0.1);
  Response response;
  setup.model().evaluate(setup.blocks()[0], at, true, &response);
  EXPECT_EQ(response.derivatives.size(), 7u);
  EXPECT_EQ(response.value.regressors.size(), 1u);
  EXPECT_EQ(response.column_precision.size(), 3);  // delay + nb + taps - 2
  setup.model().evaluate(setup.blocks()[0], at, false, &response);
  EXPECT_TRUE(response.derivatives.empty());
}

}  // namespace
}  // namespace uncertainty_identification
