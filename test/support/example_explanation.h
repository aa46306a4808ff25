#pragma once

#include <limits>

#include "support/plain_estimate.h"
#include "uncertainty_identification/explanation/explanation.h"

namespace uncertainty_identification::test {

/// An explanation of a dead zone, written by hand with every field filled.
inline Explanation exampleExplanation() {
  using Eigen::Vector2d;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  Explanation example;
  example.verdict = Verdict::partly_explained;
  example.message = "the actuator has a dead zone, and the spectrum still shows something";
  example.checks_before = {{"whiteness", 812.5, 1e-40, false, "0.5 to 2 rad/s"},
                           {"variance over time", 9, 0.4, true, ""},
                           {"kurtosis", 31, 1e-8, false, "experiments run3, run7"}};
  example.checks_after = {{"whiteness", 70, 3e-9, false, "8 to 9 rad/s"},
                          {"variance over time", 8, 0.5, true, ""},
                          {"kurtosis", 1, 0.3, true, ""}};
  const Gain gain{12.25,       1.0 / 3,     11.5,         13.0,        {81.2, 88.9},
                  {0.45, 0.5}, {0.8, 0.89}, {0.91, 0.95}, {0.13, 0.1}, {0.4, kNan}};
  example.causes = {{"act_deadzone",
                     "",
                     "actuator",
                     "inputs smaller than the width have no effect",
                     0.98,
                     {"act_backlash"},
                     {{"width", "V", 0.31, 0.004, 0.303, 0.317}, {"ratio", "", 1, kNan, kNan, 2}},
                     "move the actuator slowly through zero",
                     gain},
                    {"exp_feedback",
                     "",
                     "experiment",
                     "the input follows the noise",
                     1,
                     {},
                     {},
                     "open the loop while recording",
                     {}}};
  SimulationCause zone;
  zone.what = {"act_deadzone", "input", "dead_zone", ""};
  zone.description = "the input acts through a dead zone";
  zone.advice = "drive the actuator slowly";
  zone.values = {{"half_width", 0.31, 0.004}};
  zone.curve = {"input",           "input", {-1, 0, 1}, {-0.69, 0, 0.69}, {-0.7, -0.01, 0.68},
                {-0.68, 0.01, 0.7}};
  zone.ties = {{"act_backlash", "play", "play", ""}};
  zone.fit_before = 81;
  zone.fit_after = 89.5;
  example.causes[0].simulation = zone;
  example.simulation.preparation = "12 records, simulated in 24 windows";
  example.simulation.order = 2;
  example.simulation.lasting_oscillation = 50;
  example.simulation.causes = {zone};
  example.simulation.fit_before = 81;
  example.simulation.fit_after = 89.5;
  example.simulation.pictures = {
      {"run1", 0.5, 0.1, Vector2d(0.5, kNan), Vector2d(0.4, 1), Vector2d(0.5, 2)}};
  example.simulation.seconds = 0.25;
  example.candidates = {{"act_deadzone", "", 412.5, 12.25, 1.0 / 3},
                        {"plant_temp", "temp", -3, kNan, kNan}};
  example.warnings = {"only 12 experiments were kept out of the fit"};
  example.before = plainEstimate(Vector2d(1, 0.5), Vector2d(-0.5, 0.1));
  example.after = plainEstimate(Vector2d(1.1, 0.5), Vector2d(-0.5, 0.1));
  example.after.effects = {{"act_deadzone", "", {{"width", "V", 0.31, 0.004, 0.005}}}};
  example.held_out = {"run1", "run2"};
  example.residual_before = {{0.5, 0.25},     {0.1, 0.2, 0.3},    0.02,
                             Vector2d(1, 2),  Vector2d(3, 1),     Vector2d(-1, 1),
                             Vector2d(-2, 2), Vector2d(-3, 3),    Vector2d(-1, 0),
                             Vector2d(0, 5),  Vector2d(0.1, 0.2), Vector2d(1, 1.5),
                             {1.5, 1.25}};
  example.residual_after = example.residual_before;
  example.residual_after.of_experiment = {1, 0.75};
  example.pictures = {{"run1", 0.1, Vector2d(1, -1), Vector2d(0.5, kNan), Vector2d(0.4, 1),
                       Vector2d(0.5, 2), Vector2d(0.2, 0.2), Vector2d(0.1, 0.1)}};
  example.termination = Termination::converged;
  example.seconds = 1.5;
  return example;
}

}  // namespace uncertainty_identification::test
