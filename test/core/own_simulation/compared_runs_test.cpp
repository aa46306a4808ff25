#include "own_simulation/compared_runs.h"

#include <gtest/gtest.h>

#include <cmath>

#include "own_simulation/logged_simulation.h"
#include "support/error_message.h"
#include "uncertainty_identification/errors.h"

namespace uncertainty_identification {
namespace {

/// y = gain u, or what `answers` says.
class GainSimulation : public Simulation {
 public:
  std::string description() const override { return "the gain"; }
  std::vector<SimulationParameter> parameters() const override { return {{"gain", 2, ""}}; }
  bool canRerun() const override { return true; }
  Eigen::VectorXd run(const SimulationInput& input, const Eigen::VectorXd& values) override {
    ++calls;
    return answers.size() > 0 ? answers : Eigen::VectorXd(values[0] * input.u);
  }
  int calls = 0;
  Eigen::VectorXd answers;
};

Experiment recorded(const std::string& id, int samples) {
  Experiment experiment;
  experiment.id = id;
  experiment.sample_time = 0.1;
  experiment.u = experiment.y = Eigen::VectorXd::LinSpaced(samples, 0, 1);
  return experiment;
}

Eigen::VectorXd gain(double value) { return Eigen::VectorXd::Constant(1, value); }

TEST(ComparedRuns, RunsOnceForEachExperimentAndValue) {
  GainSimulation simulation;
  const std::vector<Experiment> experiments{recorded("a", 50), recorded("b", 50)};
  const ComparedData data = comparedData(experiments, 0, 1);
  SimulationRuns runs(simulation, 4, {});
  for (int repeat = 0; repeat < 3; ++repeat)
    for (const ComparedRun& run : data.runs)
      EXPECT_EQ(runs.output(run, gain(3)), 3 * run.experiment->u);
  EXPECT_EQ(simulation.calls, 2);
  EXPECT_EQ(runs.count(), 2);
  EXPECT_TRUE(runs.affords(2));
  EXPECT_FALSE(runs.affords(3));
  EXPECT_TRUE(runs.endedEarly());
}

TEST(ComparedRuns, ProgressMayCancel) {
  GainSimulation simulation;
  int told = -1;
  SimulationRuns runs(simulation, 100, [&told](int count) {
    told = count;
    return false;
  });
  EXPECT_FALSE(runs.affords(1));
  EXPECT_EQ(told, 0);
}

TEST(ComparedRuns, SaysWhatIsWrongWithAnAnswer) {
  GainSimulation simulation;
  const std::vector<Experiment> experiments{recorded("run7", 50)};
  const ComparedData data = comparedData(experiments, 0, 1);
  const auto complaint = [&] {
    SimulationRuns runs(simulation, 100, {});
    return messageOf<DataError>([&] { runs.output(data.runs[0], gain(2)); });
  };
  simulation.answers = Eigen::VectorXd::Zero(49);
  EXPECT_EQ(complaint(),
            "the gain, experiment 'run7': it returned 49 samples for 50 samples of the input");
  simulation.answers = Eigen::VectorXd::Zero(50);
  simulation.answers[12] = std::nan("");
  EXPECT_NE(complaint().find("sample 12 of its output is not a finite number"), std::string::npos);
  SimulationRuns runs(simulation, 100, {});
  EXPECT_FALSE(runs.output(data.runs[0], gain(3)).allFinite()) << "other values may be impossible";
}

TEST(ComparedRuns, FewExperimentsAreDividedIntoUnits) {
  std::vector<Experiment> experiments{recorded("a", 90), recorded("b", 90)};
  experiments[0].valid.assign(90, 1);
  experiments[0].valid[40] = 0;
  const ComparedData first = comparedData(experiments, 0, 2.0 / 3);
  EXPECT_EQ(first.runs[0].blocks, (std::vector<int>{0, 12, 24, 36, 48, 60}));
  EXPECT_EQ(first.samples(), 119);
  const ComparedData rest = comparedData(experiments, 2.0 / 3, 1);
  EXPECT_EQ(rest.runs[1].blocks.front(), 60);
  EXPECT_EQ(rest.samples(), 60);
  const ComparedData many = comparedData(std::vector<Experiment>(12, recorded("c", 40)), 0, 1);
  EXPECT_EQ(many.runs[0].blocks, (std::vector<int>{0, 40}));
}

TEST(ComparedRuns, FitIsOfTheDeviationFromTheMean) {
  std::vector<Experiment> experiments{recorded("a", 30)};
  experiments[0].y = Eigen::VectorXd::Constant(30, 4);
  experiments[0].y.head(15).setConstant(2);
  const ComparedData data = comparedData(experiments, 0, 1);
  EXPECT_NEAR(data.power(), 30, 1e-12);
  EXPECT_NEAR(data.fitOf(0.3), 90, 1e-9);
  EXPECT_NEAR(data.fitOf(30), 0, 1e-9);
}

TEST(LoggedSimulation, IsASignalOfTheExperiments) {
  const auto simulation = makeLoggedSimulation("y_sim", "the column y_sim");
  EXPECT_FALSE(simulation->canRerun());
  SimulationInput input{
      0.1, Eigen::VectorXd::Zero(3), {{"y_sim", Eigen::Vector3d(1, 2, 3)}}, {}, {}};
  EXPECT_EQ(simulation->run(input, {}), Eigen::Vector3d(1, 2, 3));
  input = {0.1, Eigen::VectorXd::Zero(3), {}, {{"y_sim", 4}}, {}};
  EXPECT_EQ(simulation->run(input, {}), Eigen::Vector3d(4, 4, 4));
  input.scalars.clear();
  EXPECT_NE(messageOf<DataError>([&] { simulation->run(input, {}); }).find("the column y_sim"),
            std::string::npos);
  Experiment experiment = recorded("a", 3);
  experiment.signals = {{"y_sim", Eigen::Vector3d(1, 2, 3)}, {"temp", Eigen::Vector3d(1, 2, 3)}};
  EXPECT_EQ(withoutSignal({experiment}, "y_sim")[0].signals.size(), 1u);
}

}  // namespace
}  // namespace uncertainty_identification
