#include "explanation/unconfirmed_causes.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/mentions.h"

namespace uncertainty_identification {
namespace {

/// Tests fail with a curve of the sensor and a spread, both of which simulate clearly better; the
/// simulation withheld a curve of these names.
Explanation withheld(const std::vector<std::string>& names) {
  Explanation found;
  found.checks_before = found.checks_after = {{"whiteness", 1, 1e-9, false, ""}};
  found.verdict = Verdict::partly_explained;
  for (const std::string name : {"sens_wiener", "plant_parameter_spread"}) {
    Cause cause;
    cause.name = name;
    cause.gain = Gain{};
    cause.gain->nrmse_fit_percent = {87, 90};
    found.causes.push_back(cause);
  }
  found.simulation.withheld = names;
  return found;
}

std::vector<std::string> left(Explanation found) {
  dropBesideWithheld(&found);
  std::vector<std::string> names;
  for (const Cause& cause : found.causes) names.push_back(cause.name);
  return names;
}

/// The outflow of a tank by the root of its level, which the likelihood lacks, looks to it like a
/// curve of the sensor.
TEST(UnconfirmedCauses, ACurveIsNotNamedWhereTheSimulationShowsAnother) {
  EXPECT_EQ(left(withheld({"plant_cubic"})), std::vector<std::string>{"plant_parameter_spread"});
  EXPECT_EQ(left(withheld({"plant_cubic", "sens_wiener"})).size(), 2u) << "a tie of it";
  EXPECT_EQ(left(withheld({})).size(), 2u);
  Explanation clipped = withheld({"plant_product"});
  clipped.causes[0].name = "sens_clip";
  clipped.causes[0].seen_in_samples = true;
  EXPECT_EQ(left(clipped).size(), 2u) << "the samples show a limit by themselves";
}

TEST(UnconfirmedCauses, OneThatIsDroppedIsToldWithWhatIsInItsPlace) {
  Explanation found = withheld({"plant_cubic"});
  found.causes.pop_back();
  dropBesideWithheld(&found);
  EXPECT_EQ(found.verdict, Verdict::unknown);
  ASSERT_EQ(found.warnings.size(), 1u);
  EXPECT_TRUE(test::mentions(found.warnings[0], "sens_wiener: found by the likelihood"));
  EXPECT_TRUE(test::mentions(found.warnings[0], "plant_cubic in its place"));
}

}  // namespace
}  // namespace uncertainty_identification
