#include "own_simulation/change_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "own_simulation/linear_simulation.h"
#include "support/own_machine.h"

namespace uncertainty_identification {
namespace {

/// A first-order lag with gain 1 and time constant 0.1 s, and a machine that differs.
class ChangeFitting : public testing::Test {
 protected:
  static std::unique_ptr<Simulation> lag() {
    OwnModelOptions options;
    options.physical = {{"gain", 1.0}, {"tau1", 0.1}};
    return makeLinearSimulation(factorsOf(options, MachineOptions().sample_time), "the lag");
  }

  /// Keeps the experiments, to which the data refer.
  const ComparedData& record(const Eigen::Vector3d& values, const MachineOptions& options = {}) {
    experiments_ = recordMachine(*simulation_, values, options);
    data_ = comparedData(experiments_, 0, 1);
    runs_ = std::make_unique<SimulationRuns>(*simulation_, 100000, nullptr);  // which keeps outputs
    changed_ = std::make_unique<ChangedSimulation>(*runs_, data_);
    return data_;
  }

  static Change at(ChangeKind kind, int parameter, double coordinate) {
    return {kind, parameter, Eigen::VectorXd::Constant(1, coordinate)};
  }

  std::unique_ptr<Simulation> simulation_ = lag();
  std::unique_ptr<SimulationRuns> runs_;
  std::vector<Experiment> experiments_;
  ComparedData data_;
  std::unique_ptr<ChangedSimulation> changed_;
};

TEST_F(ChangeFitting, FindsTwoParametersAtOnce) {
  record({1.3, 0.14, 0});
  const ChangeFit fit = fitChanges(
      *changed_, data_, {at(ChangeKind::parameter, 0, 0), at(ChangeKind::parameter, 1, 0)});
  const Eigen::VectorXd values = changed_->values(fit.changes);
  EXPECT_NEAR(values[0], 1.3, 4 * 1.3 * std::sqrt(fit.covariance(0, 0)));
  EXPECT_NEAR(values[1], 0.14, 4 * 0.14 * std::sqrt(fit.covariance(1, 1)));
  EXPECT_LT(std::sqrt(fit.covariance(0, 0)), 0.002);
  EXPECT_NEAR(data_.fitOf(fit.squared_error), 96.84, 0.1) << "the noise is left: 30 dB";
}

TEST_F(ChangeFitting, StandardErrorsAreThoseOfRepeatedRecords) {
  constexpr int kRepeats = 200;
  double sum = 0, squares = 0, told = 0;
  for (int seed = 1; seed <= kRepeats; ++seed) {
    MachineOptions options;
    options.seed = static_cast<std::uint64_t>(seed);
    options.samples = 60;
    options.spread = 0.05;
    record({1, 0.1, 0}, options);
    const ChangeFit fit = fitChanges(*changed_, data_, {at(ChangeKind::gain, -1, 0)});
    sum += fit.changes[0].at[0];
    squares += fit.changes[0].at[0] * fit.changes[0].at[0];
    told += fit.covariance(0, 0) / kRepeats;
  }
  const double spread = std::sqrt(squares / kRepeats - sum * sum / kRepeats / kRepeats);
  EXPECT_NEAR(std::sqrt(told) / spread, 1, 0.15) << "experiments differ, and are the units";
  EXPECT_NEAR(sum / kRepeats, 0, 4 * spread / std::sqrt(kRepeats));
}

TEST_F(ChangeFitting, LeavingUnitsOutCostsMoreThanFittingThem) {
  record({1.1, 0.1, 0});
  const ChangeFit none = fitChanges(*changed_, data_, {});
  const ChangeFit gain = fitChanges(*changed_, data_, {at(ChangeKind::gain, -1, 0)});
  const ChangeFit useless =
      fitChanges(*changed_, data_, {at(ChangeKind::gain, -1, 0), at(ChangeKind::offset, -1, 0)});
  EXPECT_EQ(none.left_out_of.size(), 20);
  EXPECT_NEAR(none.leftOut(), none.squared_error, 1e-9 * none.squared_error);
  EXPECT_GT(gain.leftOut(), gain.squared_error);
  EXPECT_LT(gain.leftOut(), 0.2 * none.leftOut());
  EXPECT_LT(useless.squared_error, gain.squared_error);
  EXPECT_GT(useless.leftOut() - useless.squared_error, gain.leftOut() - gain.squared_error);
}

TEST_F(ChangeFitting, ExactlyLeavesAUnitOutOfALinearFit) {
  record({1.1, 0.1, 0});
  const Changes gain{at(ChangeKind::gain, -1, 0)};
  const ChangeFit all = fitChanges(*changed_, data_, gain);
  ComparedData rest = data_, alone = data_;
  rest.runs.erase(rest.runs.begin() + 3);
  alone.runs = {data_.runs[3]};
  const ChangeFit without = fitChanges(*changed_, rest, gain);
  EXPECT_NEAR(all.left_out_of[3], errorsOf(*changed_, alone, without.changes).sum(),
              1e-6 * all.left_out_of[3]);
}

TEST_F(ChangeFitting, TransientsAreFittedToEachExperiment) {
  MachineOptions options;
  options.output_change = [](const Eigen::VectorXd& y, int run) {
    Eigen::VectorXd with = y;
    for (Eigen::Index k = 0; k < y.size(); ++k)
      with[k] += (run - 9.5) * std::exp(-static_cast<double>(k) / 12);
    return with;
  };
  record({1, 0.1, 0}, options);
  const double before = errorsOf(*changed_, data_, {}).sum();
  const double after = errorsOf(*changed_, data_, {at(ChangeKind::initial_state, -1, 12)}).sum();
  EXPECT_LT(after, 0.1 * before);
  EXPECT_EQ(transientOf({}, 5).cols(), 0);
  EXPECT_NEAR(transientOf({at(ChangeKind::initial_state, -1, 2)}, 5)(4, 0), std::exp(-2.0), 1e-12);
}

TEST_F(ChangeFitting, MissingSamplesDoNotCount) {
  record({1.1, 0.1, 0});
  for (Experiment& experiment : experiments_) {
    experiment.valid.assign(300, 1);
    for (std::size_t k = 100; k < 200; ++k) {
      experiment.valid[k] = 0;
      experiment.y[static_cast<Eigen::Index>(k)] = std::nan("");
    }
  }
  const ComparedData data = comparedData(experiments_, 0, 1);
  EXPECT_EQ(data.samples(), 4000);
  const ChangeFit fit = fitChanges(*changed_, data, {at(ChangeKind::gain, -1, 0)});
  EXPECT_NEAR(fit.changes[0].at[0], 0.1, 0.005);
}

TEST_F(ChangeFitting, TellsHowACoordinateDiffersFromRunToRun) {
  MachineOptions options;
  options.spread = 0.1;
  record({1, 0.1, 0}, options);
  const Changes changes =
      fitChanges(*changed_, data_, {at(ChangeKind::gain, -1, 0), at(ChangeKind::parameter, 1, 0)})
          .changes;
  const std::vector<RunSpread> spread = spreadOf(*changed_, data_, changes);
  EXPECT_TRUE(spread[0].significant);
  EXPECT_NEAR(spread[0].deviation, 0.1, 0.04);
  EXPECT_FALSE(spread[1].significant) << "the time constant is the same in all";
  record({1.1, 0.1, 0});
  EXPECT_FALSE(spreadOf(*changed_, data_, {at(ChangeKind::gain, -1, 0.1)})[0].significant);
  ComparedData few = data_;
  few.runs.resize(4);
  EXPECT_FALSE(spreadOf(*changed_, few, {at(ChangeKind::gain, -1, 0.1)})[0].significant);
}

TEST_F(ChangeFitting, EndsWhereNoRunIsLeft) {
  record({1.3, 0.14, 0});
  SimulationRuns few(*simulation_, 70, {});
  const ChangedSimulation limited(few, data_);
  const ChangeFit fit = fitChanges(limited, data_, {at(ChangeKind::parameter, 1, 0)});
  EXPECT_TRUE(few.endedEarly());
  EXPECT_LE(few.count(), 90);
  EXPECT_TRUE(std::isfinite(fit.squared_error));
}

/// y = a constant `level` [V] that is 0 in the simulation.
class LevelSimulation : public Simulation {
 public:
  std::string description() const override { return "the level"; }
  std::vector<SimulationParameter> parameters() const override { return {{"level", 0, "V"}}; }
  bool canRerun() const override { return true; }
  Eigen::VectorXd run(const SimulationInput& input, const Eigen::VectorXd& values) override {
    return (input.u.array() + 500 * values[0]).matrix();
  }
};

TEST(ChangedSimulation, AParameterThatIsZeroHasAStepOfItsOwn) {
  LevelSimulation simulation;
  SimulationRuns runs(simulation, 1000, {});
  const std::vector<Experiment> experiments =
      recordMachine(simulation, Eigen::VectorXd::Constant(1, 0.004), {});
  const ComparedData data = comparedData(experiments, 0, 1);
  const ChangedSimulation changed(runs, data);
  const ChangeFit fit =
      fitChanges(changed, data, {{ChangeKind::parameter, 0, Eigen::VectorXd::Zero(1)}});
  EXPECT_NEAR(changed.values(fit.changes)[0], 0.004, 1e-4);
  EXPECT_NEAR(changed.valueAt(0, fit.changes[0].at[0]), 0.004, 1e-4);
  EXPECT_GT(changed.slopeAt(0, 0), 0);
}

TEST_F(ChangeFitting, DerivativesAreThoseOfTheOutput) {
  record({1, 0.1, 0});
  const Changes changes{at(ChangeKind::parameter, 1, 0.1), at(ChangeKind::delay, -1, 1.3),
                        at(ChangeKind::lag, -1, 2.0), at(ChangeKind::gain, -1, 0.2),
                        at(ChangeKind::offset, -1, 0.5)};
  const Eigen::MatrixXd slopes = changed_->derivatives(data_.runs[0], changes);
  ASSERT_EQ(slopes.cols(), estimatedCoordinates(changes));
  for (Eigen::Index k = 0; k < slopes.cols(); ++k) {
    Eigen::VectorXd step = Eigen::VectorXd::Zero(slopes.cols());
    step[k] = 1e-3;
    const Eigen::VectorXd central = (changed_->output(data_.runs[0], moved(changes, step)) -
                                     changed_->output(data_.runs[0], moved(changes, -step))) /
                                    2e-3;
    EXPECT_LT((slopes.col(k) - central).norm(), 0.02 * central.norm()) << k;
  }
}

TEST(Changes, MoveByTheirEstimatedCoordinates) {
  Changes changes{{ChangeKind::initial_state, -1, Eigen::VectorXd::Constant(1, 30)},
                  {ChangeKind::lag, -1, Eigen::VectorXd::Constant(1, 2)},
                  {ChangeKind::time_constant, -1, Eigen::Vector2d(1, 2)}};
  EXPECT_EQ(estimatedCoordinates(changes), 3);
  changes = moved(changes, Eigen::Vector3d(-5, 0.5, 0.25));
  EXPECT_EQ(changes[0].at[0], 30) << "chosen, not estimated";
  EXPECT_EQ(changes[1].at[0], 0) << "no lag is negative";
  EXPECT_EQ(changes[2].at, Eigen::VectorXd(Eigen::Vector2d(1.5, 2.25)));
  EXPECT_TRUE(changes[1].isSame(startsOf(ChangeKind::lag, -1, 100)[0]));
  EXPECT_FALSE(changes[1].isSame(changes[2]));
}

}  // namespace
}  // namespace uncertainty_identification
