// What confirms a cause where no experiment is held out.
#include "explanation/confirmation.h"

#include <gtest/gtest.h>

#include "explanation/simulation_answer.h"
#include "support/mentions.h"

namespace uncertainty_identification {
namespace {

constexpr LastThirds kClear{20, 20, 0.5};

/// A play that explains all of one record by the likelihood, and that the free simulation shows in
/// windows of one length only.
Explanation playOfOneRecord() {
  Explanation found;
  Cause play;
  play.name = "act_backlash";
  play.gain = Gain{};
  play.gain->nrmse_fit_percent = {78, 97};
  found.causes = {play};
  found.verdict = Verdict::explained;
  found.checks_after = {{"whiteness", 1, 0.5, true, ""}};
  found.simulation.preparation = "1 record";
  found.simulation.fit_before = found.simulation.fit_after = 78;
  found.simulation.refused = "act_backlash: is not found in windows of 133";
  found.simulation.withheld = {"act_backlash", "plant_coulomb"};
  return found;
}

TEST(Confirmation, IsOfLastThirdsThatGainClearly) {
  Explanation found = playOfOneRecord();
  found.simulation.withheld.clear();
  EXPECT_TRUE(test::mentions(confirmationOf(kClear, found), "the last third more likely by 20"));
  EXPECT_EQ(confirmationOf(LastThirds{5, 20, 0.5}, found), "");
  EXPECT_EQ(confirmationOf(LastThirds{20, 5, 0.5}, found), "");
  EXPECT_EQ(confirmationOf(LastThirds{20, 20, 0.9}, found), "");
  EXPECT_EQ(confirmationOf({}, found), "");
}

TEST(Confirmation, IsOfOneCauseThatExplainsAll) {
  Explanation found = playOfOneRecord();
  found.verdict = Verdict::partly_explained;
  EXPECT_EQ(confirmationOf(kClear, found), "");
  found = playOfOneRecord();
  found.causes.push_back(found.causes.front());
  EXPECT_EQ(confirmationOf(kClear, found), "");
  found.causes.clear();
  EXPECT_EQ(confirmationOf(kClear, found), "");
}

TEST(FoundTwice, IsTheOnlyCauseIfTheSimulationShowsItInWindowsOfOneLength) {
  Explanation found = playOfOneRecord();
  EXPECT_TRUE(isFoundTwice(found));
  found.simulation.withheld = {"plant_coulomb"};
  EXPECT_FALSE(isFoundTwice(found));
  found = playOfOneRecord();
  found.causes.push_back(found.causes.front());
  EXPECT_FALSE(isFoundTwice(found));
  found.causes.clear();
  EXPECT_FALSE(isFoundTwice(found));
}

TEST(FoundTwice, KeepsTheCauseInTheAnswerAndSaysSo) {
  const auto answered = [](Explanation found, const std::optional<LastThirds>& gains) {
    joinSimulation(&found, gains);
    return found;
  };
  const std::string told = "named all the same";
  const Explanation kept = answered(playOfOneRecord(), {});
  ASSERT_EQ(kept.causes.size(), 1u);
  EXPECT_TRUE(test::anyMentions(kept.warnings, told));
  EXPECT_TRUE(test::anyMentions(answered(playOfOneRecord(), kClear).warnings, told))
      << "beside what the last thirds say";
  Explanation held_out = playOfOneRecord();
  held_out.held_out = {"12"};
  EXPECT_TRUE(test::anyMentions(answered(held_out, {}).warnings, told));
  Explanation alone = playOfOneRecord();
  alone.simulation.withheld.clear();
  EXPECT_TRUE(answered(alone, {}).causes.empty());
}

/// Whatever else is wrong takes part of its error away by some curve.
TEST(SimulationAnswer, CurvesThatLeaveMostOfTheErrorStandOnlyWhereAllTestsPass) {
  const auto answered = [](bool passes) {
    Explanation found = playOfOneRecord();
    found.held_out = {"12"};
    found.checks_after.front().passed = passes;
    if (!passes) found.causes.clear();
    found.verdict = passes ? Verdict::explained : Verdict::unknown;
    SimulationCause play;
    play.what = {"act_backlash", "play", "play", ""};
    play.fit_before = 78;
    play.fit_after = found.simulation.fit_after = 82;
    found.simulation.causes = {play};
    joinSimulation(&found, {});
    return found;
  };
  EXPECT_TRUE(answered(false).causes.empty());
  ASSERT_EQ(answered(true).causes.size(), 1u);
  EXPECT_TRUE(answered(true).causes.front().simulation);
}

TEST(SimulationAnswer, CurvesThatLeaveMostDoNotTakeThePlaceOfAnUnverifiedCause) {
  Explanation found = playOfOneRecord();
  found.simulation.withheld.clear();
  found.simulation.fit_after = 82;
  SimulationCause drag;
  drag.what = {"plant_drag", "rate", "signed_square", ""};
  found.simulation.causes = {drag};
  joinSimulation(&found, {});
  EXPECT_TRUE(found.causes.empty());
  EXPECT_TRUE(test::anyMentions(found.warnings, "plant_drag: raises the fit")) << "and it is told";
}

TEST(SimulationAnswer, NothingIsNotSaidBesideACurveOfTheSimulation) {
  Explanation found = playOfOneRecord();
  found.causes.clear();
  found.verdict = Verdict::none;
  SimulationCause play;
  play.what = {"act_backlash", "play", "play", ""};
  found.simulation.fit_after = 82;
  found.simulation.causes = {play};
  joinSimulation(&found, {});
  EXPECT_EQ(found.verdict, Verdict::unknown);
  EXPECT_TRUE(test::mentions(found.message, "rises from 78 to 82 % by act_backlash"))
      << found.message;
}

}  // namespace
}  // namespace uncertainty_identification
