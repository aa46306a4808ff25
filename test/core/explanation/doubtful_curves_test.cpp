// Curves that were found and do not tell the cause.
#include "explanation/doubtful_curves.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/mentions.h"

namespace uncertainty_identification {
namespace {

/// A sine of amplitude 5 that a sensor reads in these steps.
std::vector<Experiment> readInSteps(double step) {
  std::vector<Experiment> experiments(1);
  experiments[0].u = Eigen::VectorXd::LinSpaced(200, 0, 1);
  experiments[0].y = Eigen::VectorXd(200);
  for (int t = 0; t < 200; ++t)
    experiments[0].y[t] = step * std::round(5 / step * std::sin(0.3 * t));
  return experiments;
}

/// One cause with which the fit rises from `before` to `after`, and a picture of it.
SimulationCauses found(const PlaceAndShape& what, double before, double after) {
  SimulationCauses simulation;
  simulation.causes.resize(1);
  simulation.causes[0].what = what;
  simulation.fit_before = before;
  simulation.fit_after = after;
  simulation.pictures = {{"1", 0, 1, {}, Eigen::Vector2d(1, 2), Eigen::Vector2d(3, 4)}};
  return simulation;
}

void expectNone(const SimulationCauses& simulation, const std::string& why) {
  EXPECT_TRUE(simulation.causes.empty());
  EXPECT_EQ(simulation.fit_after, simulation.fit_before);
  EXPECT_EQ(simulation.pictures.at(0).after, simulation.pictures.at(0).before);
  EXPECT_TRUE(test::mentions(simulation.refused, why)) << simulation.refused;
}

TEST(DoubtfulCurves, PlayAsWideAsTheSensorsStepsIsNotNamed) {
  constexpr double kStep = 0.5;
  const auto remaining = [&](double half_width) {
    SimulationCauses simulation =
        found({"sens_backlash", "output_play", "output_play", ""}, 90, 95);
    simulation.causes[0].values = {{"half_width", half_width, 0.01}};
    dropDoubtfulCurves(readInSteps(kStep), &simulation);
    return simulation;
  };
  EXPECT_EQ(remaining(2 * kStep).causes.size(), 1u);
  expectNone(remaining(kStep), "hardly wider than the steps of 0.5");
}

TEST(DoubtfulCurves, NoCauseIsNamedBesideAnOscillationThatNothingDamps) {
  SimulationCauses simulation = found({"plant_coulomb", "rate", "coulomb", ""}, 97, 98);
  dropDoubtfulCurves(readInSteps(0.01), &simulation);
  EXPECT_EQ(simulation.causes.size(), 1u);
  simulation.lasting_oscillation = 50;
  simulation.refused = "plant_sine: not confirmed";
  simulation.withheld = {"plant_sine"};
  dropDoubtfulCurves(readInSteps(0.01), &simulation);
  expectNone(simulation, "an oscillation of the linear plant at 50 Hz");
  EXPECT_TRUE(test::mentions(simulation.refused, "plant_sine: not confirmed; plant_coulomb"));
  EXPECT_TRUE(simulation.withheld.empty()) << "was found with the same plant";
}

/// Half of the squared error of a fit of 90 % is left by one of 92.9 %.
TEST(DoubtfulCurves, NoCauseIsNamedThatLeavesMostOfTheError) {
  const auto remaining = [](double after) {
    SimulationCauses simulation =
        found({"sens_backlash", "output_play", "output_play", ""}, 90, after);
    dropCurvesThatLeaveMost(&simulation);
    return simulation;
  };
  EXPECT_EQ(remaining(93).causes.size(), 1u);
  expectNone(remaining(92.8), "leaves more than half of the squared error");
  EXPECT_TRUE(remaining(std::nan("")).causes.empty());
}

/// Fits of 80 and 85 %: squared errors of 400 and 225.
TEST(DoubtfulCurves, NoiseThatNoCauseCanTakeAwayIsNotCounted) {
  const auto remaining = [](double share, double after) {
    SimulationCauses simulation = found({"plant_coulomb", "rate", "coulomb", ""}, 80, after);
    simulation.unpredictable_share = share;
    dropCurvesThatLeaveMost(&simulation);
    return simulation.causes.size();
  };
  EXPECT_EQ(remaining(0.9, 85), 1u) << "22 of 198 are left beyond noise";
  EXPECT_EQ(remaining(0.2, 85), 0u) << "180 of 355";
  EXPECT_EQ(remaining(1, 82), 0u) << "less than a quarter is gained";
}

TEST(DoubtfulCurves, NoCauseIsNamedWhereTheSimulationStaysPoor) {
  const auto remaining = [](double after) {
    SimulationCauses simulation = found({"plant_sine", "position", "sine", ""}, -88, after);
    dropDoubtfulCurves(readInSteps(0.01), &simulation);
    return simulation;
  };
  EXPECT_EQ(remaining(61).causes.size(), 1u);
  expectNone(remaining(50.5), "from -88 to 50.5 %, which leaves too much unexplained");
}

/// A sine whose frequency becomes `ratio` times as high.
std::vector<Experiment> sweep(double ratio) {
  std::vector<Experiment> experiments(1);
  experiments[0].u = experiments[0].y = Eigen::VectorXd::Zero(300);
  for (int t = 0; t < 300; ++t)
    experiments[0].u[t] = experiments[0].y[t] = std::sin(0.05 * t * (1 + (ratio - 1) * t / 600));
  return experiments;
}

TEST(DoubtfulCurves, AGainThatChangesWithTimeIsNotToldFromOneOfTheFrequency) {
  const PlaceAndShape drift{"plant_drift", "time_gain", "exponential", ""};
  SimulationCauses simulation = found(drift, 58, 78);
  dropDoubtfulCurves(sweep(6), &simulation);
  expectNone(simulation, "the frequency of the input changes during the experiments as well");
  simulation = found(drift, 58, 78);
  dropDoubtfulCurves(sweep(1), &simulation);
  EXPECT_EQ(simulation.causes.size(), 1u);
  simulation = found({"act_saturation", "input", "saturation", ""}, 58, 78);
  dropDoubtfulCurves(sweep(6), &simulation);
  EXPECT_EQ(simulation.causes.size(), 1u);
}

}  // namespace
}  // namespace uncertainty_identification
