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
  return explanation;
}

TEST(OpenAnswers, ACurveThatHalvesTheErrorIsNotComparedWithALinearPlant) {
  EXPECT_FALSE(isOpen(withCurve("square", 91)));
  EXPECT_TRUE(isOpen(withCurve("square", 89))) << "plants that differ may look so";
  EXPECT_TRUE(isOpen(withCurve("curve", 99))) << "may stand for levels that differ";
  Explanation passing = withCurve("square", 91);
  passing.checks_before = {};
  EXPECT_TRUE(isOpen(passing));
}

TEST(OpenAnswers, WhatIsNotNamedIsOpen) {
  Explanation nothing = withCurve("square", 91);
  nothing.causes.clear();
  nothing.simulation.causes.clear();
  EXPECT_TRUE(isOpen(nothing));
}

}  // namespace
}  // namespace uncertainty_identification
