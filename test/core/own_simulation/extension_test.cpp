// Changes in the units of the data.
#include "own_simulation/extension.h"

#include <gtest/gtest.h>

#include <cmath>

#include "own_simulation/linear_simulation.h"
#include "support/own_machine.h"

namespace uncertainty_identification {
namespace {

Change changeOf(ChangeKind kind, std::initializer_list<double> at, int parameter = -1) {
  Change change{kind, parameter, Eigen::VectorXd(static_cast<Eigen::Index>(at.size()))};
  std::copy(at.begin(), at.end(), change.at.data());
  return change;
}

class ExtensionOf : public testing::Test {
 protected:
  ExtensionOf() {
    OwnModelOptions model;
    model.physical = {{"gain", 2.0}, {"tau1", 0.1}};
    simulation_ = makeLinearSimulation(factorsOf(model, 0.02), "the model");
    experiments_ = recordWithFactor(*simulation_, -1, 1, {});
    data_ = comparedData(experiments_, 0, 1);
  }

  OwnExtension with(const Changes& changes, bool is_surrogate = false) {
    SimulationRuns runs(*simulation_, 1000, nullptr);
    return extensionOf(ChangedSimulation(runs, data_), changes, 0.02, *simulation_, is_surrogate);
  }

  std::unique_ptr<Simulation> simulation_;
  std::vector<Experiment> experiments_;
  ComparedData data_;
};

TEST_F(ExtensionOf, IsInSecondsAndInUnitsOfTheData) {
  const OwnExtension extension =
      with({changeOf(ChangeKind::delay, {1.5}), changeOf(ChangeKind::gain, {0.1}),
            changeOf(ChangeKind::offset, {0.3}), changeOf(ChangeKind::initial_state, {20})});
  EXPECT_NEAR(extension.delay, 0.03, 1e-12);
  EXPECT_NEAR(extension.gain, 1.1, 1e-12);
  EXPECT_NEAR(extension.offset, 0.3, 1e-12);
  EXPECT_NEAR(extension.transient, 0.4, 1e-12);
  EXPECT_EQ(extension.lag, 0);
  const OwnExtension times =
      with({changeOf(ChangeKind::time_constant, {std::log(2.0), std::log(3.0)})});
  EXPECT_NEAR(times.lead, 0.04, 1e-12);
  EXPECT_NEAR(times.lag, 0.06, 1e-12);
  EXPECT_NEAR(with({changeOf(ChangeKind::lag, {4})}).lag, 0.08, 1e-12);
}

TEST_F(ExtensionOf, HoldsTheParametersAndTheFilters) {
  const OwnExtension extension = with({changeOf(ChangeKind::parameter, {std::log(1.5)}, 0)});
  ASSERT_EQ(extension.parameters.size(), 3u);
  EXPECT_NEAR(extension.parameters[0].value, 3, 1e-12);
  EXPECT_NEAR(extension.parameters[1].value, 0.1, 1e-12);
  ASSERT_TRUE(extension.yours && extension.measured);
  const double pole = std::exp(-0.2);
  EXPECT_NEAR(extension.yours->den[1], -pole, 1e-9);
  EXPECT_NEAR(extension.yours->num.sum() / extension.yours->den.sum(), 2, 1e-9);
  EXPECT_NEAR(extension.measured->num.sum() / extension.measured->den.sum(), 3, 1e-9);
  EXPECT_TRUE(with({}, true).parameters.empty()) << "those of a linear model are not the user's";
}

TEST_F(ExtensionOf, ASimulationThatIsNotLinearHasNoFilters) {
  PendulumSimulation pendulum;
  SimulationRuns runs(pendulum, 1000, nullptr);
  EXPECT_FALSE(
      extensionOf(ChangedSimulation(runs, data_), {}, 0.02, pendulum, false).yours.has_value());
}

}  // namespace
}  // namespace uncertainty_identification
