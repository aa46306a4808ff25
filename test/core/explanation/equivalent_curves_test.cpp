#include "explanation/equivalent_curves.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace uncertainty_identification {
namespace {

using Names = std::vector<std::string>;

Cause causeOf(const std::string& name, const Names& equivalent) {
  Cause cause;
  cause.name = name;
  cause.equivalent = equivalent;
  return cause;
}

TEST(TellEquivalentCurves, NamesTheOtherPlacesThatTheSimulationFound) {
  Explanation explanation;
  explanation.causes = {causeOf("act_hammerstein", {"sens_wiener"})};
  SimulationCause found;
  found.what = {"plant_root", "position", "root", ""};
  found.ties = {{"act_hammerstein", "input", "square", ""},
                {"sens_wiener", "sensor", "square", ""}};
  explanation.simulation.causes = {found};
  tellEquivalentCurves(&explanation);
  const Names& names = explanation.causes[0].equivalent;
  EXPECT_EQ(names[0], "sens_wiener");
  EXPECT_EQ(names[1], "plant_root");
  EXPECT_EQ(std::count(names.begin(), names.end(), "sens_wiener"), 1);
}

TEST(TellEquivalentCurves, TellsThePlantBetweenTheInputAndTheSensor) {
  Explanation explanation;
  explanation.causes = {causeOf("sens_wiener", {"act_hammerstein"})};
  explanation.causes[0].description = "curve";
  explanation.message = "curve (sens_wiener or act_hammerstein): all checks pass";
  tellEquivalentCurves(&explanation);
  EXPECT_EQ(explanation.message,
            "curve (sens_wiener or act_hammerstein or plant_curve): all checks pass");
  EXPECT_EQ(explanation.causes[0].equivalent, (Names{"act_hammerstein", "plant_curve"}));
}

TEST(TellEquivalentCurves, LeavesCausesThatNothingElseExplains) {
  Explanation explanation;
  explanation.causes = {causeOf("sens_wiener", {}), causeOf("act_deadzone", {"act_hammerstein"})};
  SimulationCause found;
  found.what = {"exp_input2", "covariate", "linear", "load"};
  explanation.simulation.causes = {found};
  tellEquivalentCurves(&explanation);
  EXPECT_TRUE(explanation.causes[0].equivalent.empty());
  EXPECT_EQ(explanation.causes[1].equivalent, Names{"act_hammerstein"});
}

}  // namespace
}  // namespace uncertainty_identification
