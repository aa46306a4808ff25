#include "explanation/open_answers.h"

#include <gtest/gtest.h>

namespace uncertainty_identification {
namespace {

/// A curve of the input by which the fit of the simulation rises from 80 %; tests fail.
Explanation withCurve(const std::string& shape, double fit_after) {
  Explanation explanation;
  explanation.verdict = Verdict::partly_explained;
  explanation.checks_before =
      explanation.checks_after = {{"dependence on the input", 1, 1e-9, false, ""}};
  Cause cause;
  cause.name = "act_hammerstein";
  explanation.causes = {cause};
  explanation.simulation.fit_before = 80;
  explanation.simulation.fit_after = fit_after;
  SimulationCause curve;
  curve.what = {cause.name, "input", shape, ""};
  curve.fit_before = 80;
  curve.fit_after = fit_after;
  explanation.simulation.causes = {curve};
  explanation.causes[0].simulation = curve;
  explanation.held_out_fit = 81;
  return explanation;
}

TEST(OpenAnswers, ACurveThatHalvesTheErrorIsNotComparedWithALinearPlant) {
  EXPECT_FALSE(isOpen(withCurve("square", 91)));
  EXPECT_TRUE(isOpen(withCurve("square", 89))) << "plants that differ may look so";
  EXPECT_TRUE(isOpen(withCurve("curve", 99))) << "may stand for levels that differ";
  Explanation passing = withCurve("square", 91);
  passing.checks_before = {};
  EXPECT_TRUE(isOpen(passing));
  Explanation levels = withCurve("square", 91);
  levels.held_out_fit = 90;
  EXPECT_TRUE(isOpen(levels)) << "the linear model, with offsets of its own, simulates as well";
  levels.held_out_fit.reset();
  EXPECT_TRUE(isOpen(levels)) << "nothing is held out";
  Explanation second = withCurve("square", 91);
  second.causes[0].simulation->fit_before = 90;
  EXPECT_TRUE(isOpen(second)) << "another cause does most";
  Explanation noise = withCurve("square", 91);
  noise.checks_before[0].name = "tails";
  EXPECT_TRUE(isOpen(noise));
}

TEST(OpenAnswers, WhatIsNotNamedIsOpen) {
  Explanation nothing = withCurve("square", 91);
  nothing.causes.clear();
  nothing.simulation.causes.clear();
  EXPECT_TRUE(isOpen(nothing));
}

}  // namespace
}  // namespace uncertainty_identification
